// SPDX-License-Identifier: GPL-2.0-or-later
// Extension module grainfall._core. Loading it announces the classes to YADE's factory; register_classes()
// makes them known to the running YADE. Both are done by importing the package, which first checks that this
// YADE is the one that the module was compiled for. Registration is not part of the module's initialisation
// because an error raised there reaches Python without its message.
#include "register_classes.hpp"
#include "scene_file.hpp"

#include <lib/base/Math.hpp>

#include <boost/python/stl_iterator.hpp>

namespace {

boost::python::list register_classes() {
    boost::python::list names;
    for (const std::string& name : grainfall::register_new_classes())
        names.append(name);
    return names;
}

void write_scene(const std::string& path, const boost::python::list& left_out) {
    grainfall::write_scene(path, {boost::python::stl_input_iterator<std::string>(left_out), {}});
}

} // namespace

BOOST_PYTHON_MODULE(_core) {
    boost::python::def(
        "register_classes", &register_classes,
        "Register in the running YADE the classes that are not there yet; returns their names.");
    boost::python::def(
        "write_scene", &write_scene, (boost::python::arg("path"), boost::python::arg("left_out")),
        "Write what O.save would, but for engines of these classes; O.filename stays as it is.");
}

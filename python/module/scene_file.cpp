// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene_file.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>

#include <fstream>
#include <stdexcept>

namespace grainfall {

void write_scene(const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    if (!file)
        throw std::runtime_error("cannot write " + path);
    {
        const boost::shared_ptr<yade::Scene> scene = yade::Omega::instance().getScene();
        boost::archive::binary_oarchive archive(file);
        archive << boost::serialization::make_nvp("scene", scene);
    }
    file.close();
    if (!file)
        throw std::runtime_error("cannot write " + path + ": disk full?");
}

} // namespace grainfall

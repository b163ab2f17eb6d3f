// SPDX-License-Identifier: GPL-2.0-or-later
// A class with an attribute of every supported kind, flag and hook.
#pragma once

#include <lib/base/Logging.hpp>
#include <lib/serialization/Serializable.hpp>
#include <core/Material.hpp>

namespace yade {

class AbiSample : public Serializable {
public:
    virtual ~AbiSample() = default;

    void postLoad(AbiSample&) {
        ++postLoads;
        doubled = 2 * number;
    }
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;
    void warn(const std::string& message);

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(AbiSample, Serializable,
        "Attributes of every kind. One positional argument sets :yref:`AbiSample.number`.",
        ((Real, number, 1.5, Attr::triggerPostLoad, "a number [m]."))
        ((Real, doubled, 3, Attr::noSave, "twice the number."))
        ((int, postLoads, 0, (Attr::noSave | Attr::readonly), "how often postLoad ran."))
        ((int, secret, 42, Attr::hidden, "not seen from Python."))
        ((bool, flag, true, , "a flag."))
        ((unsigned int, natural, 7u, , "a natural number."))
        ((long, big, 1L << 40, , "a long integer."))
        ((std::string, text, "abc", , "a text."))
        ((Vector3r, position, Vector3r(1, 2, 3), , "a vector."))
        ((Vector3i, cell, Vector3i(1, 2, 3), , "an integer vector."))
        ((Quaternionr, turn, Quaternionr::Identity(), , "an orientation."))
        ((Matrix3r, matrix, Matrix3r::Identity(), , "a matrix."))
        ((vector<Real>, numbers, vector<Real>({1., 2.}), , "numbers."))
        ((vector<int>, integers, , , "integers."))
        ((vector<std::string>, texts, , , "texts."))
        ((vector<Vector3r>, vectors, , , "vectors."))
        ((vector<vector<Real>>, table, , , "numbers in rows."))
        ((shared_ptr<Material>, material, , , "an object of a stock class."))
        ((shared_ptr<AbiSample>, next, , , "an object of this class."))
        ((vector<shared_ptr<Serializable>>, objects, , , "objects of any class."))
        ,
        ,
        .def("warn", &AbiSample::warn, (boost::python::arg("message")), "Write a text to the log as a warning.")
    );
    // clang-format on
    DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(AbiSample);

} // namespace yade

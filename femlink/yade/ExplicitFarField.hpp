// SPDX-License-Identifier: GPL-2.0-or-later
// The explicit continuum as part of a scene: mesh, materials and state, saved with it.
#pragma once

#include <lib/base/Math.hpp>
#include <lib/serialization/Serializable.hpp>

#include <memory>

namespace grainfall::femlink {
class ExplicitContinuum;
}

namespace yade {

class ExplicitFarField : public Serializable {
public:
    virtual ~ExplicitFarField() = default;
    /// Builds the continuum; wrong attributes are refused with one sentence.
    void postLoad(ExplicitFarField&);
    void preSave(ExplicitFarField&);

    /// Throws std::runtime_error if there is none yet.
    grainfall::femlink::ExplicitContinuum& continuum();

    Real critical_step();
    long substeps();
    boost::python::dict energies();
    boost::python::list state_now();

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ExplicitFarField, Serializable,
        "Continuum with inertia at finite strain (MR-2629, section 5.2), moved on step by step by its :yref:`FemWall`. Made by grainfall.femlink.add_explicit_wall.",
        ((vector<Vector3r>, vertices, , Attr::readonly, "Vertices [m]."))
        ((vector<int>, cells, , Attr::readonly, "Hexahedra: 8 vertices each, x running first."))
        ((vector<int>, regions, , Attr::readonly, "Material of each cell."))
        ((vector<int>, boundary, , Attr::readonly, "Faces: 4 vertices and id (1 outer, 2 coupling) each."))
        ((vector<Real>, solids, , Attr::readonly, "Ten numbers a region: its number, law (0 st-venant, 1 neo-hooke, 2 j2, 3 drucker-prager), Young's modulus [Pa], Poisson's ratio, density [kg/m3], yield stress [Pa], hardening [Pa], cohesion [Pa], friction angle [rad], dilatancy [rad]."))
        ((string, element, "gauss", Attr::readonly, "'gauss' or 'one-point'."))
        ((string, outer, "fixed", Attr::readonly, "Outer boundary: 'fixed', 'absorbing' or 'dashpots'."))
        ((Real, safety, 0.9, Attr::readonly, "Longest substep over the critical one [-], > 0."))
        ((Real, hourglass, 1, Attr::readonly, "Stiffness of the one-point element against hourglassing over the shear stiffness [-], >= 0."))
        ((Vector3r, gravity, Vector3r::Zero(), Attr::readonly, "Weight that drucker-prager soil is at rest under at the start [m/s2]."))
        ((vector<Real>, savedState, , Attr::hidden, "State at the last step."))
        ,
        ,
        .add_property("criticalStep", &ExplicitFarField::critical_step, "Longest stable substep [s] as the cells are now deformed.")
        .add_property("substeps", &ExplicitFarField::substeps, "Substeps taken since the start.")
        .add_property("energies", &ExplicitFarField::energies, "Kinetic, elastic, hourglass, plastic, absorbed and ground energy, and the work of the contacts [J].")
        .def("state", &ExplicitFarField::state_now, "Numbers that grainfall.femlink.ExplicitContinuum.state of the same mesh accepts.")
    );
    // clang-format on

private:
    std::shared_ptr<grainfall::femlink::ExplicitContinuum> continuum_;
};
REGISTER_SERIALIZABLE(ExplicitFarField);

} // namespace yade

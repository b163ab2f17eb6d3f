// SPDX-License-Identifier: GPL-2.0-or-later
// The contact law in YADE: looks up the kernel of the contact's class and applies the force it returns.
#pragma once

#include <laws/yade/GrainPhys.hpp>

#include <array>
#include <atomic>
#include <mutex>

#include <core/Dispatching.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

class Law2_ScGeom_GrainPhys_HertzMindlin : public LawFunctor {
public:
    Law2_ScGeom_GrainPhys_HertzMindlin(const Law2_ScGeom_GrainPhys_HertzMindlin&) = delete;
    virtual ~Law2_ScGeom_GrainPhys_HertzMindlin();

    bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* interaction) override;

    void validate() const;
    void postLoad(Law2_ScGeom_GrainPhys_HertzMindlin&);

    /// One contact, one step; false when the bodies have parted.
    using Kernel = bool (*)(Law2_ScGeom_GrainPhys_HertzMindlin&, ScGeom&, GrainPhys&, Interaction&);
    /// One kernel for each contact class.
    using KernelTable = std::array<Kernel, ContactClass::count>;

    /// Books energies [J] into O.energy; safe from all threads.
    void book(Real friction, Real viscous, Real rescaling);

    /// What the law computes in the present scene, each with the reason: {effect: reason}.
    boost::python::dict effects() const;
    /// {'normal': J, 'shear': J} stored in the contacts at this moment.
    boost::python::dict elastic_energy() const;

    FUNCTOR2D(ScGeom, GrainPhys);
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Law2_ScGeom_GrainPhys_HertzMindlin, LawFunctor,
        "Hertz-Mindlin contact with friction that may fall with load and moisture (MR-2629, Eq 3-6). Which kernel serves a contact is "
        "decided once, from these attributes and the contact's materials; :yref:`effects<Law2_ScGeom_GrainPhys_HertzMindlin.effects>` "
        "tells what runs and why. With O.trackEnergy the dissipated energies are booked into O.energy as grainFriction, grainViscous and "
        "grainRescaling.",
        ((std::string, normalLaw, "hertz", , "'hertz': 4/3 E* sqrt(R*) overlap^1.5; 'report': MR-2629 Eq 3 as printed, half of that."))
        ((std::string, tangentialLaw, "incremental", , "'incremental': Mindlin's stiffness, shear force rescaled when the stiffness falls, so that no energy is made; 'mindlin-deresiewicz': partial slip, from the rim of the contact inwards (Mindlin & Deresiewicz 1953, by the method of Popov & Hess 2015); 'report': MR-2629 Eq 4-5 as printed; 'secant': stiffness times total tangential displacement (the law of Chung & Ooi's reference codes; makes energy on normal loading); 'none': frictionless."))
        ((int, frictionIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ((int, viscousIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ((int, rescalingIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ,
        choose_kernels();
        ,
        .def(CheckedAttributes<Law2_ScGeom_GrainPhys_HertzMindlin>()
            .then(&Law2_ScGeom_GrainPhys_HertzMindlin::choose_kernels)
            .add("normalLaw", &Law2_ScGeom_GrainPhys_HertzMindlin::normalLaw)
            .add("tangentialLaw", &Law2_ScGeom_GrainPhys_HertzMindlin::tangentialLaw))
        .add_property("effects", &Law2_ScGeom_GrainPhys_HertzMindlin::effects,
            "What the law computes in the present scene, each with the reason: {effect: reason}.")
        .def("elasticEnergy", &Law2_ScGeom_GrainPhys_HertzMindlin::elastic_energy,
            "Energy stored in the contacts now: {'normal': J, 'shear': J}.")
    );
    // clang-format on
    DECLARE_LOGGER;

private:
    // Plain and energy-booking kernels; go() picks by O.trackEnergy.
    std::array<const KernelTable*, 2> kernels_ = {};
    std::mutex energy_mutex_;
    std::atomic<bool> energy_named_{false};

    void choose_kernels();
};
REGISTER_SERIALIZABLE(Law2_ScGeom_GrainPhys_HertzMindlin);

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
// The contact law in YADE: looks up the kernel of the contact's class and applies the force it returns.
#pragma once

#include <laws/yade/GrainPhys.hpp>
#include <laws/yade/attribute_checks.hpp>

#include <array>
#include <atomic>
#include <mutex>
#include <type_traits>

#include <core/Dispatching.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

/// The base that declares go(), through which YADE calls a law. Kernels are handed it as it came: turning it
/// into the law beforehand and saving the result are instructions in every contact.
template <class Base>
Base& declares_go(bool (Base::*)(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*));
using LawEntry = std::remove_reference_t<decltype(declares_go(&LawFunctor::go))>;

class Law2_ScGeom_GrainPhys_HertzMindlin : public LawFunctor {
public:
    Law2_ScGeom_GrainPhys_HertzMindlin(const Law2_ScGeom_GrainPhys_HertzMindlin&) = delete;
    virtual ~Law2_ScGeom_GrainPhys_HertzMindlin();

    bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* interaction) override;

    void validate() const;
    void postLoad(Law2_ScGeom_GrainPhys_HertzMindlin&);

    /// One contact, one step; false when the bodies have parted.
    using Kernel = bool (*)(LawEntry&, shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*);
    /// One kernel for each contact class.
    using KernelTable = std::array<Kernel, ContactClass::count>;

    /// The kernel of a class.
    Kernel kernel_of(int contact_class, bool booking) const {
        return (*kernels_[booking])[static_cast<std::size_t>(contact_class)];
    }

    /// Books energies [J] into O.energy; safe from all threads.
    void book(Real friction, Real viscous, Real rescaling, Real kinematics);
    /// Work that went into a bridge which has ruptured.
    void book_bridge(Real work);

    /// The law that serves this scene's contacts; null before its first step and where there is none.
    static const Law2_ScGeom_GrainPhys_HertzMindlin* acting_in(const Scene& scene);

    /// What the law computes in the present scene, each with the reason: {effect: reason}.
    boost::python::dict effects() const;
    /// {kernel in words: contacts that it serves now}.
    boost::python::dict kernels_in_use() const;
    /// Where the water of the scene is; see water_budget.hpp.
    boost::python::dict water() const;
    /// {'normal': J, 'shear': J, 'bridge': J} stored in the contacts at this moment.
    boost::python::dict elastic_energy() const;

    FUNCTOR2D(ScGeom, GrainPhys);
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Law2_ScGeom_GrainPhys_HertzMindlin, LawFunctor,
        "Hertz-Mindlin contact with friction that may fall with load and moisture (MR-2629, Eq 3-6). Which kernel serves a contact is "
        "decided once, from these attributes and the contact's materials; :yref:`effects<Law2_ScGeom_GrainPhys_HertzMindlin.effects>` "
        "tells what runs and why. With O.trackEnergy the dissipated energies are booked into O.energy as grainFriction, grainViscous, "
        "grainRescaling and grainBridge. YADE reckons shear displacement on the undeformed surfaces, but the force acts at the contact "
        "point: grainShearKinematics is the work that the bodies do less than the springs and sliders take for that reason.",
        ((std::string, normalLaw, "hertz", , "'hertz': 4/3 E* sqrt(R*) overlap^1.5; 'report': MR-2629 Eq 3 as printed, half of that."))
        ((std::string, tangentialLaw, "incremental", , "'incremental': Mindlin's stiffness, shear force rescaled when the stiffness falls, so that no energy is made; 'mindlin-deresiewicz': partial slip, from the rim of the contact inwards (Mindlin & Deresiewicz 1953, by the method of Popov & Hess 2015); 'report': MR-2629 Eq 4-5 as printed; 'secant': stiffness times total tangential displacement (the law of Chung & Ooi's reference codes; makes energy on normal loading); 'none': frictionless."))
        ((int, frictionIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ((int, viscousIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ((int, rescalingIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ((int, bridgeIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ((int, kinematicsIx, -1, (Attr::hidden | Attr::noSave), "place in O.energy."))
        ,
        scene = nullptr;
        choose_kernels();
        ,
        .def(CheckedAttributes<Law2_ScGeom_GrainPhys_HertzMindlin>()
            .then(&Law2_ScGeom_GrainPhys_HertzMindlin::choose_kernels)
            .add("normalLaw", &Law2_ScGeom_GrainPhys_HertzMindlin::normalLaw)
            .add("tangentialLaw", &Law2_ScGeom_GrainPhys_HertzMindlin::tangentialLaw))
        .add_property("effects", &Law2_ScGeom_GrainPhys_HertzMindlin::effects,
            "What the law computes in the present scene, each with the reason: {effect: reason}.")
        .add_property("kernels", &Law2_ScGeom_GrainPhys_HertzMindlin::kernels_in_use,
            "Which kernel serves how many contacts now, touching or held by a bridge: {kernel: contacts}. A contact runs what its own bodies "
            "ask for: in a bed with one moist layer the dry contacts have a kernel without bridges.")
        .def("elasticEnergy", &Law2_ScGeom_GrainPhys_HertzMindlin::elastic_energy,
            "Energy stored in the contacts now: {'normal': J, 'shear': J, 'bridge': J}.")
        .def("water", &Law2_ScGeom_GrainPhys_HertzMindlin::water,
            "Where the water of the scene is now [m3]: {'total': carried by the grains by their moisture, 'external': in bridges beyond "
            "that (stated bridgeVolume of bodies without moisture), 'inBridges', 'onGrains': total + external - inBridges, 'bridges': "
            "their number, 'meanRelativeVolume': mean V/R^3, 'beyondPendular': share of bridges above V/R^3 = 0.0577, where neighbours "
            "merge, 'beyondFit': share above 0.1, where the force is extrapolated, 'overdrawnGrains': grains that gave more than they "
            "carried, 'deficit': by how much}.")
    );
    // clang-format on
    DECLARE_LOGGER;

private:
    // Plain and energy-booking kernels; go() picks by O.trackEnergy.
    std::array<const KernelTable*, 2> kernels_ = {};
    std::mutex energy_mutex_;
    std::atomic<bool> energy_named_{false};
    void name_energies();

    void choose_kernels();
};
REGISTER_SERIALIZABLE(Law2_ScGeom_GrainPhys_HertzMindlin);

} // namespace yade

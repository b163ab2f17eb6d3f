// SPDX-License-Identifier: GPL-2.0-or-later
// Contact forces on one solid of revolution, summed by zone of its surface.
#pragma once

#include <lib/base/Math.hpp>
#include <core/GlobalEngine.hpp>
#include <core/Body.hpp>

#include <engines/projectile/yade/SolidOfRevolution.hpp>

namespace yade {

class ProjectileLoad : public GlobalEngine {
public:
    virtual ~ProjectileLoad() = default;
    void action() override;

    Vector3r totalForce() const { return noseForce + shaftForce + baseForce; }
    Vector3r totalImpulse() const { return noseImpulse + shaftImpulse + baseImpulse; }
    Vector3r totalTorque() const { return noseTorque + shaftTorque + baseTorque; }
    int contacts() const { return noseContacts + shaftContacts + baseContacts; }

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ProjectileLoad, GlobalEngine,
        "Sums in each step the contact forces [N] on a :yref:`SolidOfRevolution` by zone, and their moments [N m] about its "
        "centroid, in global axes. Place it after the :yref:`InteractionLoop`. Gravity and other body forces are not in it; "
        "a contact with several zones (an edge) counts for the first of them from the nose. Works through the projectile's "
        "own contacts only. Calling the engine from Python brings it up to date without a step.",
        ((Body::id_t, body, -1, , "Id of the body; its shape is a :yref:`SolidOfRevolution`."))
        ((Vector3r, noseForce, Vector3r::Zero(), Attr::readonly, "Force on the nose [N]."))
        ((Vector3r, shaftForce, Vector3r::Zero(), Attr::readonly, "Force on the shaft [N]."))
        ((Vector3r, baseForce, Vector3r::Zero(), Attr::readonly, "Force on the base [N]."))
        ((Vector3r, noseTorque, Vector3r::Zero(), Attr::readonly, "Moment of the force on the nose [N m]."))
        ((Vector3r, shaftTorque, Vector3r::Zero(), Attr::readonly, "Moment of the force on the shaft [N m]."))
        ((Vector3r, baseTorque, Vector3r::Zero(), Attr::readonly, "Moment of the force on the base [N m]."))
        ((Vector3r, noseImpulse, Vector3r::Zero(), , "Force on the nose times step, summed over the steps since it was last set to zero [N s]: the exact mean between two moments."))
        ((Vector3r, shaftImpulse, Vector3r::Zero(), , "The same for the shaft [N s]."))
        ((Vector3r, baseImpulse, Vector3r::Zero(), , "The same for the base [N s]."))
        ((long, impulseStep, -1, Attr::hidden, "Step that the impulses have counted last."))
        ((int, noseContacts, 0, Attr::readonly, "Number of contacts on the nose."))
        ((int, shaftContacts, 0, Attr::readonly, "Number of contacts on the shaft."))
        ((int, baseContacts, 0, Attr::readonly, "Number of contacts on the base."))
        , ,
        .add_property("totalForce", &ProjectileLoad::totalForce, "Sum of the three forces [N].")
        .add_property("totalImpulse", &ProjectileLoad::totalImpulse, "Sum of the three impulses [N s].")
        .add_property("totalTorque", &ProjectileLoad::totalTorque, "Sum of the three moments [N m].")
        .add_property("contacts", &ProjectileLoad::contacts, "Number of all contacts.")
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(ProjectileLoad);

} // namespace yade

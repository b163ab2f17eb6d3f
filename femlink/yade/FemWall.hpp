// SPDX-License-Identifier: GPL-2.0-or-later
// The deformable wall of a scene: owns the surface, solves its contacts and moves its faces.
//
// Before the contacts of a step are computed:
//
//   pairs (face, sphere) that are near      from the collider, or from the flat path's search
//   -> contacts, each owned by one face     femlink/core/surface_contacts.hpp
//   -> shear history that has changed face  moved from interaction to interaction
//   -> forces and displacement              femlink/core/wall_contacts.hpp
//   -> FaceTouch on each face               read by Ig2_FemFace_Sphere_ScGeom, then the contact law acts
#pragma once

#include <lib/base/Math.hpp>
#include <core/GlobalEngine.hpp>
#include <core/Interaction.hpp>

#include <femlink/core/wall_contacts.hpp>
#include <femlink/yade/ExplicitFarField.hpp>
#include <femlink/yade/FemFace.hpp>
#include <femlink/yade/scene_walls.hpp>
#include <laws/yade/attribute_checks.hpp>

#include <memory>
#include <utility>

namespace yade {

class FemWall : public GlobalEngine {
public:
    virtual ~FemWall() = default;

    /// On YADE's own interaction loop; GrainInteractionLoop calls `prepare` itself.
    void action() override;
    void validate() const;
    void postLoad(FemWall&);
    void preSave(FemWall&);

    /// Solves the wall for this step. `pairs`: all that are near one of this wall's faces, sorted. Contacts
    /// that change face take their interactions' history along.
    void prepare(const vector<FacePair>& pairs, FunctorLists& lists);
    /// Interactions of this wall's faces in the scene, as pairs.
    vector<FacePair> pairs_in_scene(FunctorLists& lists);
    /// From GrainInteractionLoop where it runs as InteractionLoop.
    void prepare_in_scene();
    bool has_face(const Body& body);

    /// Contacts that the wall's place had before it stood there (faces by body id, shear forces on the
    /// spheres): its faces take them over, and it is where it is under their forces.
    void take_over(const vector<int>& face_ids, const vector<int>& spheres, const vector<Vector3r>& shear);

    /// Infinite for walls without inertia.
    ExchangeLimit exchange_limit() const;

    boost::python::list node_positions();
    boost::python::list node_displacements();
    boost::python::list node_forces();
    boost::python::list face_nodes();
    boost::python::list touches_now();

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(FemWall, GlobalEngine,
        "Deformable wall: an elastic continuum (MR-2629, section 3.4) that grains touch at its surface, condensed to that surface and solved together with "
        "its contacts before each step. Stands between the collider and the :yref:`InteractionLoop`, whose functors must include "
        ":yref:`Ig2_FemFace_Sphere_ScGeom` and :yref:`Law2_FemGeom_GrainPhys_HertzMindlin`, the collider's :yref:`Bo1_FemFace_Aabb`. Made by "
        "grainfall.femlink.add_wall, which makes the faces too. Small displacements, no inertia.",
        ((string, file, "", Attr::readonly, "Wall file (grainfall.femlink.WallModel.save) with surface and compliance."))
        ((string, key, "", Attr::readonly, "Key of the wall in the file: of mesh, materials and loads."))
        ((vector<int>, faces, , Attr::readonly, "Ids of the bodies that are its faces, in their order in the file."))
        ((shared_ptr<ExplicitFarField>, continuum, , Attr::readonly, "Continuum with inertia, in the place of a file; None for a quasi-static wall."))
        ((string, coupling, "implicit", , "'implicit': forces and displacement of a step are solved for together, stable for any stiffness; 'staggered': the wall takes the forces of the step before, as "
          "in the report; refused where that must diverge."))
        ((int, interval, 1, , "Solve for all contacts together in every n-th step [-], >= 1. In between each contact is solved alone, what the others do to the wall there going evenly to what the last such solution found."))
        ((Real, patch, 1.25, , "Radius of the disc over which a contact's load is spread, over the face's size [-], >= 0; 0: the report's point load."))
        ((Real, drift, 0.002, , "How far a contact may move before its load follows it, over the patch's radius [-], >= 0. 0 follows at each step."))
        ((Real, tolerance, 1e-6, , "Of the solver: largest change of a force in its last sweep over the largest force [-], in (0, 1)."))
        ((int, maxSweeps, 300, , "Sweeps over the contacts (or iterations for all of them) after which a step is left as it is, the next going on from there [-], >= 1; if forces then still change by more than a fifth of the largest, the run stops with an error."))
        ((Vector3r, velocity, Vector3r::Zero(), , "Velocity [m/s] of the outer boundary, and with it of the whole wall as a rigid body."))
        ((Vector3r, shift, Vector3r::Zero(), Attr::readonly, "How far the outer boundary has moved [m]."))
        ((int, contacts, 0, Attr::readonly, "Contacts in the last step."))
        ((int, sweeps, 0, Attr::readonly, "Sweeps, or iterations, of the solver in the last step that solved."))
        ((Real, lastChange, 0, Attr::readonly, "Largest change of a force in the last sweep over the largest force [-]."))
        ((long, unfinishedSteps, 0, Attr::readonly, "Steps in which the tolerance was not reached within maxSweeps."))
        ((Real, disagreement, 0, Attr::readonly, "Largest difference in the last step but one between the force that the wall was solved for and that of the law, over the largest force [-]."))
        ((Real, boundaryWork, 0, Attr::readonly, "Work [J] that moving the outer boundary has supplied."))
        ((Real, storedEnergy, 0, Attr::readonly, "Strain energy that the contacts have put into the wall [J]."))
        ((Vector3r, force, Vector3r::Zero(), Attr::readonly, "Sum of the contact forces on the wall in the last step [N]."))
        ((vector<Vector3r>, datum, , Attr::readonly, "Displacement [m] of the nodes that counts as none: that under the forces which :yref:`takeOver<FemWall.takeOver>` found. Empty: zero."))
        ((long, preparedStep, -1, Attr::hidden, "Last step that contacts were looked for in."))
        ((long, solvedStep, -1, Attr::hidden, "Last step that the wall was solved for."))
        ((vector<Vector3r>, startForces, , Attr::readonly, "Forces [N] on the nodes that a continuum with inertia is at rest under: those which :yref:`takeOver<FemWall.takeOver>` found. Empty: zero."))
        ((Real, dissipatedEnergy, 0, Attr::readonly, "Energy [J] that a continuum with inertia has lost to plastic flow and through its absorbing boundary."))
        ((int, glideStep, 0, Attr::hidden, "Steps since the continuum was moved on."))
        ((int, loadsSummed, 0, Attr::hidden, "Steps in savedLoadSum."))
        ((vector<Vector3r>, savedGlideStart, , Attr::hidden, "Displacement of the nodes when the continuum was moved on."))
        ((vector<Vector3r>, savedLoadSum, , Attr::hidden, "Sum of the nodes' forces since then."))
        ((vector<Vector3r>, savedDisplacement, , Attr::hidden, "Of the nodes, at the last step."))
        ((vector<Vector3r>, savedForces, , Attr::hidden, "On the nodes, at the last step."))
        ((vector<Vector3i>, savedTouches, , Attr::hidden, "Sphere, face of the contact and face of its anchor; -1 for an empty place."))
        ((vector<vector<Real>>, savedNumbers, , Attr::hidden, "Of each contact: anchor (2), its normal, force, what it sees of the wall, its drift, velocity of the wall (3 each)."))
        ,
        ,
        .def(CheckedAttributes<FemWall>().add("coupling", &FemWall::coupling).add("interval", &FemWall::interval)
            .add("patch", &FemWall::patch).add("drift", &FemWall::drift).add("tolerance", &FemWall::tolerance)
            .add("maxSweeps", &FemWall::maxSweeps).add("velocity", &FemWall::velocity))
        .def("nodePositions", &FemWall::node_positions, "Nodes of the surface as they now lie [m].")
        .def("nodeDisplacements", &FemWall::node_displacements, "What the contacts add to the nodes' places [m].")
        .def("nodeForces", &FemWall::node_forces, "Forces of the contacts on the nodes [N].")
        .def("faceNodes", &FemWall::face_nodes, "Nodes of each face.")
        .def("takeOver", &FemWall::take_over, (boost::python::arg("faces"), boost::python::arg("spheres"), boost::python::arg("shear")),
             "Before the first step, O.engines and O.dt set: these spheres touch these faces (body ids) already, with these elastic shear forces on the spheres [N], as in the rigid "
             "container where they came to rest. The wall is taken to be where it is under their forces, so that they stay at rest (:yref:`datum<FemWall.datum>`).")
        .def("touches", &FemWall::touches_now,
             "Contacts of the last step: dicts with sphere (body id), face (body id), reference (on the face, -1 to 1), point [m], normal, overlap [m], force on the sphere [N], "
             "displacement of the wall there [m].")
    );
    // clang-format on
    DECLARE_LOGGER;

private:
    /// What YADE has of touches_, same place.
    struct Partner {
        shared_ptr<Interaction> contact;
        shared_ptr<Interaction> trial; // with the physics that the contact would have, while it is not real
        Body* face = nullptr;
        Body* sphere = nullptr;
        Vector3r velocity = Vector3r::Zero(); // m/s, of the wall at the contact, without that of its boundary
        bool found = false;                   // in this step
    };

    std::unique_ptr<grainfall::femlink::QuasiStaticWall> wall_;
    vector<FemFace*> shapes_;
    vector<int> face_of_body_; // -1: not of this wall
    vector<grainfall::femlink::WallTouch> touches_;
    vector<Partner> partners_;
    grainfall::femlink::Positions positions_; // of the surface's nodes, without `shift`
    Real largest_displacement_ = 0;
    grainfall::femlink::Positions glide_start_, load_sum_;
    using Place = std::pair<Body::id_t, size_t>; // a sphere, and where in touches_
    using Places = std::pair<vector<Place>::const_iterator, vector<Place>::const_iterator>;
    vector<Place> places_; // sorted
    struct {               // of one sphere
        vector<int> near;
        vector<grainfall::femlink::HeldFace> held;
        vector<grainfall::femlink::SurfaceContact> found;
        vector<char> placed;
    } look_;
    bool surface_moved_ = true;
    bool restored_ = false;    // interactions not known yet
    bool has_bridges_ = false; // has a contact had liquid?
    FunctorLists lists_;       // on YADE's own loop
    const Engine* listed_loop_ = nullptr;
    const Law2_ScGeom_GrainPhys_HertzMindlin* law_ = nullptr; // of this step; null with YADE's own laws
    const FunctorLists* checked_lists_ = nullptr;

    int face_of(Body::id_t id) const {
        return id >= 0 && static_cast<size_t>(id) < face_of_body_.size()
                   ? face_of_body_[static_cast<size_t>(id)]
                   : -1;
    }
    static vector<Vector3r> by_node(const grainfall::femlink::Positions& columns);
    void see_surface();
    void set_up();
    void restore();
    void find_interactions();
    shared_ptr<Engine> interaction_loop() const;
    void check_functors(FunctorLists& lists) const;
    void compare_with_law();
    using NextPair = vector<FacePair>::const_iterator;
    void find_touches(const vector<FacePair>& pairs);
    void find_touches_of(NextPair begin, NextPair end);
    size_t known_touch(const Places& of_sphere, const FacePair& pair) const;
    size_t new_touch();
    void forget_touch(size_t place);
    void follow(size_t place, const grainfall::femlink::SurfaceContact& found, const FacePair& pair);
    void make(const shared_ptr<Interaction>& contact, size_t place, FunctorLists& lists) const;
    void find_physics(FunctorLists& lists);
    bool touches_wall(size_t place) const;
    grainfall::femlink::LawContact law_contact(size_t place, int steps = 1) const;
    void carry(Interaction& from, Interaction& to) const;
    void solve(bool together);
    void solve_together(const vector<grainfall::femlink::LawContact>& laws,
                        const grainfall::femlink::SolverOptions& options);
    void move_continuum();
    void see_continuum();
    void read_law_forces();
    void read_pulls();
    void exchange(const vector<grainfall::femlink::LawContact>& laws);
    void settle();
    void write_faces();
    void move_faces();
    FaceTouch face_touch(size_t place) const;
    Real radius_of(size_t place) const;
};
REGISTER_SERIALIZABLE(FemWall);

} // namespace yade

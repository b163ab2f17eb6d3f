// SPDX-License-Identifier: GPL-2.0-or-later
// A scene's grains and their contacts in packed arrays, and the way from YADE's objects to them and back.
//
// Spheres of GrainMat, and the obstacles (walls, boxes, solids of revolution) of GrainMat that they meet by
// the usual geometry, are `flat`: the motion of the spheres and all these contacts live here, and YADE's
// State, forces and interactions are written when someone is about to look (publish). What else is in the
// scene keeps YADE's own way, contact by contact (general pairs). Every contact has its Interaction from the
// step in which it is made, but the scene's container takes it in, and lets go of those whose bodies have
// parted, only when contacts are published: what comes and goes between two looks never passes through the
// container, and each thread makes the contacts of its own spheres.
//
//   take_over  YADE's objects -> arrays        after Python or a foreign engine may have changed them
//   search     sorts the spheres in space, lists the pairs that are near each other
//   contacts   forces of all contacts, one loop for each contact class and thread
//   move       leapfrog of the spheres
//   publish    arrays -> YADE's objects
#pragma once

#include <engines/flat/motion_book.hpp>
#include <engines/flat/neighbours.hpp>
#include <engines/flat/yade/flat_kernels.hpp>
#include <engines/flat/yade/functor_lists.hpp>
#include <engines/flat/yade/general_pairs.hpp>
#include <femlink/yade/scene_walls.hpp>

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace yade {

class FemFace;

class FlatGrains {
public:
    /// Spheres [begin, end), their contacts and near pairs: the work of one thread. A pair belongs to the
    /// lower of its spheres, so that loads of other threads are added to from below only.
    struct Domain {
        int begin = 0, end = 0;
        int loaded_end = 0; // one past the last sphere that its contacts can push
        vector<FlatContacts> segments;
        vector<grainfall::flat::Pair> near;           // of spheres
        vector<grainfall::flat::Pair> near_obstacles; // an obstacle and a sphere
        vector<grainfall::flat::Load> loads;          // of all bodies
        FlatBook book;
        vector<vector<size_t>> opened;               // by segment
        vector<size_t> touching, touching_obstacles; // of `near` and `near_obstacles`
        // Contacts that only the scene's container still holds; those which it must let go of at once.
        vector<shared_ptr<Interaction>> parted, parted_exposed;
        long born_now = 0, parted_now = 0; // contacts made and lost in this step
        // Two spheres as the geometry functor is to see them; their own State may be another thread's too.
        shared_ptr<State> first_state = boost::make_shared<State>(),
                          second_state = boost::make_shared<State>();
        std::exception_ptr failure; // of this thread in this step
    };

    /// Margins of the search: each sphere gets `skin` [m] and what it travels in `horizon` [s].
    struct Reach {
        Real skin, horizon;
    };

    struct Census {
        long steps = 0, searches = 0, takeovers = 0, publications = 0, born = 0, parted = 0;
    };

    FunctorLists functors;
    Census census;

    /// Why this scene cannot run flat; empty if it can.
    std::string obstacle(const Scene& scene) const;

    /// `slips`: does the law remember partial slip?
    void take_over(Scene& scene, int threads, bool slips);
    /// Has anything moved further than the last search allowed for?
    bool must_search() { return moved_ || others_have_moved(); }
    void search(Reach reach);
    /// Contact forces of this step. `publish`: YADE's interactions and forces are written too.
    void contacts(Scene& scene, const FlatTables::Pair& tables, bool publish);
    /// The scene's container lets go of contacts that have parted and takes in those that are new.
    void list_contacts(Scene& scene);
    /// Motion of the spheres; `scene.forces` are in sync. Returns the highest speed squared [m2/s2].
    Real move(Scene& scene, const grainfall::flat::StepRules& rules, bool keep_velocities);
    /// Position, velocity, orientation and spin of the spheres into their State.
    void publish_states();
    /// State of the spheres, which someone may have changed, into the arrays.
    void take_over_states();

    bool is_flat(Body::id_t id) const {
        return id < static_cast<Body::id_t>(index_of_.size()) && index_of_[static_cast<size_t>(id)] >= 0 &&
               !bodies_.is_obstacle(index_of_[static_cast<size_t>(id)]);
    }
    /// Velocity and spin before the last step; known where the states after it were published.
    const grainfall::flat::Motion& earlier_motion(Body::id_t id) const {
        return earlier_[static_cast<size_t>(index_of_[static_cast<size_t>(id)])];
    }
    /// Bodies that YADE's way moves: walls, projectiles, all that is no flat sphere.
    const vector<Body*>& others() const { return others_; }

    size_t contact_count() const;
    size_t near_count() const;
    size_t general_count() const { return general_.size(); }
    int sphere_count() const { return bodies_.spheres(); }

    /// Of the spheres in this step.
    const grainfall::flat::MotionBook& motion_book() const { return motion_book_; }
    bool states_are_published() const { return states_published_; }
    Real smallest_radius() const { return smallest_radius_; }

private:
    /// Where a sphere was at the last search, and how far it may go until the next.
    struct Anchor {
        Vector3r centre;
        Real margin;
    };
    struct Bounds {
        Vector3r low, high;
        bool meets(const Bounds& other) const {
            return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
        }
        bool holds(const Bounds& other) const {
            return (low.array() <= other.low.array()).all() && (other.high.array() <= high.array()).all();
        }
    };
    /// A body that is no flat sphere: where it was at the last search, and where it may go.
    struct Roamer {
        Body* body;
        Vector3r centre;
        Quaternionr orientation;
        Bounds room;
        const FemFace* face; // of a deformable wall, else null
        int obstacle;        // index, -1: no obstacle
    };
    struct Moved {
        grainfall::flat::MotionBook book;
        Real fastest = 0; // m2/s2
        bool beyond_margin = false;
    };
    struct Imported : grainfall::flat::Contact<ContactOwner> {
        int contact_class;
        grainfall::flat::Partner partner;
    };
    struct Step {
        const FlatTable& table;
        Real length; // s
        long number;
        bool publish;
    };

    grainfall::flat::Bodies bodies_;
    vector<Body*> yade_;   // by index
    vector<int> index_of_; // by id, -1: not flat
    vector<Body*> others_;
    vector<Roamer> roamers_;
    Real smallest_radius_ = 0;
    Real giant_radius_ = 0; // a sphere larger than that is a giant
    vector<int> giants_;
    vector<int> touched_by_others_; // flat spheres in general pairs, by index
    vector<Anchor> anchors_;        // by index
    vector<grainfall::flat::Motion> earlier_;
    vector<Domain> domains_;
    GeneralPairs general_;
    vector<FacePair> face_pairs_; // those of faces of deformable walls with spheres, as of this version:
    long face_pairs_version_ = -1;
    bool moved_ = true;
    bool booking_ = false;
    bool slipping_ = false; // does the law remember partial slip?
    bool has_room_ = false; // has the force container places for obstacles and clumps?
    bool forces_published_ = false;
    bool contacts_published_ = false; // in the last step
    bool states_published_ = false;
    grainfall::flat::MotionBook motion_book_;
    bool same_masks_ = true;

    void take_over_bodies(Scene& scene);
    std::optional<grainfall::flat::Obstacle> obstacle_of(const Body& body) const;
    void find_functors();
    void take_over_contacts(Scene& scene, vector<Imported>& contacts);
    Imported imported(const shared_ptr<Interaction>& contact) const;
    FlatContacts& segment(Domain& domain, int contact_class, grainfall::flat::Partner partner) const;
    FlatContacts& add_contact(Domain& domain, Imported contact) const;
    void note_plane_radius(int first, const Interaction& contact);
    grainfall::flat::DashpotMemory recall_dashpots(const ContactOwner& owner) const;
    void read_obstacles();
    void share_out(const vector<int>& place_of);
    void take_contacts(Domain& domain, vector<FlatContacts>& former, const vector<int>& place_of) const;
    void set_anchors(Reach reach);
    void measure_radii();
    bool is_giant(int sphere) const {
        return bodies_.places[static_cast<size_t>(sphere)].radius > giant_radius_;
    }
    vector<int> sort_spheres(const grainfall::flat::CellTable& cells);
    void list_near(Domain& domain, const grainfall::flat::CellTable& cells) const;
    int owner_of(int first, int second) const {
        return bodies_.is_obstacle(first) ? second : std::min(first, second);
    }
    bool near_enough(int first, int second) const;
    Bounds box_of(const Body& body);
    Bounds room_of(const Body& body, Reach reach);
    bool others_have_moved();
    bool has_gone_too_far(const Roamer& roamer) const;
    void note_roamers(Reach reach);
    void list_near_obstacles(Domain& domain, const grainfall::flat::CellTable& cells) const;
    template <class Visit>
    void visit_spheres_in(const Roamer& roamer, const grainfall::flat::CellTable& cells,
                          const Visit& visit) const;
    void list_general(const grainfall::flat::CellTable& cells);

    void start_booking(bool booking);
    void start_remembering_slip(bool slipping);
    void run(Domain& domain, size_t segment, const Step& step, vector<size_t>& opened, size_t begin,
             size_t end) const;
    void run_domain(Domain& domain, const Step& step) const;
    void find_touching(Domain& domain) const;
    void bury(Domain& domain) const;
    void bear(Domain& domain, const Step& step, vector<grainfall::flat::Pair>& near,
              const vector<size_t>& touching);
    bool make_contact(Domain& domain, const Step& step, grainfall::flat::Pair pair, Imported& made);
    void write_state(State& state, size_t index) const;
    void publish_state(size_t index) const;
    void publish_forces(Scene& scene);
    void settle_books();
    void load_obstacles(Scene& scene);
    void show_exposed(Scene& scene);
    void prepare_walls(Scene& scene);
    grainfall::flat::Load take_load(size_t index);
    Moved move_domain(const Domain& domain, Scene& scene, const grainfall::flat::StepRules& rules,
                      bool all_with_yade);
};

} // namespace yade

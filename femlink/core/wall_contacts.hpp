// SPDX-License-Identifier: GPL-2.0-or-later
// A quasi-static wall through the steps of a run: contacts that come, move and go, and the wall's
// displacement under them.
//
// With x(X) the surface as it lies when no contact loads it, n the direction of the push and w what the
// contact sees of the wall's displacement (compliance.hpp), a sphere at c with radius R overlaps by
//
//   d = R - n . (c - x(X)) + n . w
//
// which is linear in w: that overlap is solved for, and the same number is handed to the contact law. X and n
// are those of the point nearest to c on the surface as the last step left it.
//
// A wall that grains were settled on (`settle_under`) lies where it is under their forces: of w, the datum,
// what those forces do to the wall, is taken off.
//
// A contact's load stays where it is until the contact has moved by `drift` of the patch's radius, for moving
// it means building its patch and its compliance anew, and points where it does until the normal has turned
// by more than `turn`, which in a wall that bends is every few steps, but means only that its axes turn.
#pragma once

#include <femlink/core/law_contact.hpp>
#include <femlink/core/staggered.hpp>
#include <femlink/core/surface_contacts.hpp>
#include <femlink/core/wall_model.hpp>
#include <femlink/core/wall_solver.hpp>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace grainfall::femlink {

// One contact of a sphere with the surface.
struct WallTouch {
    int sphere = -1; // a number that the caller knows the sphere by; -1: this place is empty
    SurfaceContact place;
    ContactSite site;                                // where the load goes
    SurfaceContact anchor;                           // that `site` was made for
    double free_overlap = 0;                         // m, if no contact loaded the wall
    Eigen::Vector3d force = Eigen::Vector3d::Zero(); // N on the sphere, in the site's axes
    double pull = 0; // N, towards the wall: of what joins the two besides the contact, as liquid does
    Point seen = Point::Zero(), seen_before = Point::Zero(); // m, of the wall, now and a step before

    // N, of the last solution for all, and its change from the one before: where the next starts.
    Eigen::Vector3d solved = Eigen::Vector3d::Zero(), trend = Eigen::Vector3d::Zero();

    // m/N, compliance of the wall at the site, in space and in its axes.
    Eigen::Matrix3d own_in_space = Eigen::Matrix3d::Zero(), own = Eigen::Matrix3d::Zero();
    Point drift = Point::Zero(); // m, of `others` in a step between solutions for all

    // m, what the loads of the other contacts do to the wall here, in the site's axes.
    Eigen::Vector3d others() const { return site.axes.transpose() * seen + own * force; }

    // The next solution for all starts from the force as it is.
    void forget_course() {
        solved = force;
        trend.setZero();
    }

    // N on the sphere, in the site's axes: the contact's force and the pull.
    Eigen::Vector3d whole_force() const { return force - pull * Eigen::Vector3d::UnitX(); }

    bool is_empty() const { return sphere < 0; }
    double overlap() const { return free_overlap + seen.dot(site.axes.col(0)); }
};

class QuasiStaticWall {
public:
    static constexpr double turn = 1e-4; // rad

    explicit QuasiStaticWall(WallModel model)
        : model_(std::make_unique<WallModel>(std::move(model))),
          unloaded_(model_->surface.nodes + model_->preload),
          displacement_(Positions::Zero(3, model_->surface.node_count())), nodal_forces_(displacement_),
          datum_(displacement_), solver_(model_->surface, model_->compliance) {}

    const WallModel& model() const { return *model_; }
    const Surface& surface() const { return model_->surface; }
    // m, nodes as they lie under gravity and surface loads.
    const Positions& unloaded() const { return unloaded_; }
    // m, what contacts add to that.
    const Positions& displacement() const { return displacement_; }
    Positions positions() const { return unloaded_ + displacement_ - datum_; }
    // m, displacement of the nodes that counts as none.
    const Positions& datum() const { return datum_; }
    void put_datum(const Positions& datum) { datum_ = datum; }

    // The wall is where it is under the forces that the touches now hold.
    void settle_under(const std::vector<WallTouch>& touches) {
        auto [sites, forces] = loads(touches);
        bear(sites, forces);
        datum_ = displacement_;
    }
    // N, of the contacts on the wall.
    const Positions& nodal_forces() const { return nodal_forces_; }

    void put(const Positions& displacement, const Positions& nodal_forces) {
        displacement_ = displacement;
        nodal_forces_ = nodal_forces;
    }

    // Moves the load to where the contact is, if it has left its place by more than `drift` of the patch's
    // radius, and turns it as the contact has turned; true if it moved.
    bool follow(WallTouch& touch, double patch, double drift) const {
        const double allowed = drift * patch * face_size(surface(), unloaded_, touch.place.face);
        const bool stays = touch.anchor.face == touch.place.face &&
                           (unloaded_point(touch.anchor) - unloaded_point(touch.place)).norm() <= allowed;
        if (stays && (touch.anchor.normal - touch.place.normal).norm() <= turn)
            return false;
        const Eigen::Matrix3d axes = touch.site.axes;
        const Point left = stays ? Point::Zero() : seen(touch.site);
        if (stays) {
            touch.anchor.normal = touch.place.normal;
            put_axes(touch);
        } else {
            touch.anchor = touch.place;
            put_site(touch, patch);
        }
        const Eigen::Matrix3d turned = touch.site.axes.transpose() * axes;
        for (Eigen::Vector3d* force : {&touch.force, &touch.solved, &touch.trend})
            *force = turned * *force;
        if (stays)
            return false;
        // Another place on the wall, not a motion of the wall.
        const Point change = seen(touch.site) - left;
        touch.seen += change;
        touch.seen_before += change;
        return true;
    }

    // Makes the site that belongs to the touch's anchor.
    void put_site(WallTouch& touch, double patch) const {
        const double radius = patch * face_size(surface(), unloaded_, touch.anchor.face);
        touch.site.patch = contact_patch(surface(), unloaded_, touch.anchor.face, touch.anchor.at, radius);
        touch.own_in_space = patch_compliance(surface(), model_->compliance, touch.site.patch);
        put_axes(touch);
    }

    // m, overlap with the unloaded wall of a sphere whose contact is `place`, its load at `site`.
    double free_overlap(const SurfaceContact& place, const ContactSite& site, const Point& centre,
                        double radius) const {
        return radius - place.normal.dot(centre - unloaded_point(place)) - seen_displacement(site, datum_)[0];
    }

    // The same for a contact that has no site yet, the datum taken at its point.
    double free_overlap(const SurfaceContact& place, const Point& centre, double radius) const {
        const Point here = point_of(place, unloaded_) - point_of(place, datum_);
        return radius - place.normal.dot(centre - here);
    }

    // Solves all contacts; `contacts` in the order of `touches`, empty places included. Pulls are given.
    SolverReport solve(std::vector<WallTouch>& touches, std::vector<LawContact> contacts,
                       const SolverOptions& options) {
        draw_out(touches, contacts);
        auto [sites, forces] = loads(touches);
        std::vector<Eigen::Matrix3d> own;
        own.reserve(touches.size());
        for (std::size_t i = 0; i < touches.size(); ++i) {
            own.push_back(touches[i].own);
            forces.segment<3>(3 * i) = touches[i].solved + touches[i].trend;
        }
        const SolverReport report = solver_.solve(sites, own, contacts, forces, options);
        for (std::size_t i = 0; i < touches.size(); ++i) {
            WallTouch& touch = touches[i];
            touch.force = forces.segment<3>(3 * i);
            touch.trend = touch.force - touch.solved;
            touch.solved = touch.force;
            forces[3 * i] -= touch.pull;
        }
        bear(sites, forces);
        return report;
    }

    // After a solution for all, if the next comes in so many steps: what the other contacts do goes to its
    // new value by then, evenly. `before`: the touch as the step before left it. A wall that jumped there in
    // one step would hit the contacts' dashpots.
    void approach(WallTouch& touch, const WallTouch& before, int steps) const {
        touch.seen = seen(touch.site);
        touch.drift = touch.site.axes * (touch.others() - before.others()) / steps;
        touch.seen = before.seen;
        touch.force = before.force;
    }

    // After a solution for all, if the next comes in the next step.
    void arrive(WallTouch& touch) const {
        touch.seen = seen(touch.site);
        touch.drift.setZero();
    }

    // Between two solutions for all, this contact alone; after one, what is left between it and its law.
    void solve_alone(WallTouch& touch, LawContact contact, const SolverOptions& options) const {
        const Eigen::Vector3d others = touch.others() + touch.site.axes.transpose() * touch.drift;
        contact.free_overlap += others[0];
        contact.shift += others.tail<2>();
        double change = 0;
        int sweeps = 0;
        do {
            const Eigen::Vector3d before = touch.force;
            touch.force = contact_force<LawContact>(contact, touch.own, touch.own * before, before);
            change = (touch.force - before).cwiseAbs().maxCoeff();
        } while (change > options.tolerance * touch.force[0] && ++sweeps < options.max_sweeps);
        touch.seen = touch.site.axes * (others - touch.own * touch.force);
    }

    // N, what the touches' forces come to on the nodes.
    Positions loads_on_nodes(const std::vector<WallTouch>& touches) const {
        const auto [sites, forces] = loads(touches);
        return femlink::nodal_forces(surface(), sites, forces);
    }

    // The staggered exchange: the wall under the forces that the law found in the last step, which the
    // touches hold. Returns its gain; from 1 on it diverges.
    double exchange(const std::vector<WallTouch>& touches, const std::vector<LawContact>& contacts) {
        const auto [sites, forces] = loads(touches);
        const double gain = staggered_gain(solver_.condense(sites), contacts);
        bear(sites, forces);
        return gain;
    }

    // From here on as if read from a file.
    void forget_matrices() { solver_.forget(); }

    // What the contacts see of the wall as it lies.
    Point seen(const ContactSite& site) const { return site.axes * seen_displacement(site, displacement_); }

private:
    static void put_axes(WallTouch& touch) {
        const Eigen::Matrix3d axes = contact_axes(touch.anchor.normal);
        touch.site.axes = axes;
        touch.own = axes.transpose() * touch.own_in_space * axes;
    }

    // The contacts on the wall as the pulls leave it.
    void draw_out(const std::vector<WallTouch>& touches, std::vector<LawContact>& contacts) const {
        if (std::none_of(touches.begin(), touches.end(), [](const WallTouch& t) { return t.pull != 0; }))
            return;
        auto [sites, pulls] = loads(touches);
        for (std::size_t i = 0; i < touches.size(); ++i)
            pulls.segment<3>(3 * i) << -touches[i].pull, 0, 0;
        const Positions drawn =
            displacements(surface(), model_->compliance, femlink::nodal_forces(surface(), sites, pulls));
        for (std::size_t i = 0; i < touches.size(); ++i) {
            const Eigen::Vector3d there = seen_displacement(touches[i].site, drawn);
            contacts[i].free_overlap += there[0];
            contacts[i].shift += there.tail<2>();
        }
    }

    Point unloaded_point(const SurfaceContact& place) const { return point_of(place, unloaded_); }

    // Interpolates a field on the nodes.
    Point point_of(const SurfaceContact& place, const Positions& field) const {
        const Surface& s = surface();
        return s.degree == 1 ? face_frame<1>(s.face<1>(place.face, field), place.at).y
                             : face_frame<2>(s.face<2>(place.face, field), place.at).y;
    }

    static std::pair<Sites, Eigen::VectorXd> loads(const std::vector<WallTouch>& touches) {
        Sites sites;
        Eigen::VectorXd forces(3 * touches.size());
        sites.reserve(touches.size());
        for (std::size_t i = 0; i < touches.size(); ++i) {
            sites.push_back(&touches[i].site);
            forces.segment<3>(3 * i) = touches[i].whole_force();
        }
        return {std::move(sites), std::move(forces)};
    }

    void bear(const Sites& sites, const Eigen::VectorXd& forces) {
        nodal_forces_ = femlink::nodal_forces(surface(), sites, forces);
        displacement_ = displacements(surface(), model_->compliance, nodal_forces_);
    }

    std::unique_ptr<WallModel> model_; // at a fixed address: solver_ refers to it
    Positions unloaded_, displacement_, nodal_forces_, datum_;
    WallSolver solver_;
};

} // namespace grainfall::femlink

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

#include <femlink/core/contact_site.hpp>
#include <femlink/core/law_contact.hpp>
#include <femlink/core/surface_contact.hpp>
#include <femlink/core/wall_model.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace grainfall::femlink {

class WallSolver;

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

    explicit QuasiStaticWall(WallModel model);
    QuasiStaticWall(QuasiStaticWall&&) noexcept;
    ~QuasiStaticWall();

    const WallModel& model() const { return *model_; }
    const Surface& surface() const { return model_->surface; }
    // m, nodes as they lie under gravity and surface loads.
    const Positions& unloaded() const { return unloaded_; }
    // m, what contacts add to that.
    const Positions& displacement() const { return displacement_; }
    Positions positions() const { return unloaded_ + displacement_ - datum_; }
    // m, displacement of the nodes that counts as none.
    const Positions& datum() const { return datum_; }
    void put_datum(const Positions& datum) {
        datum_ = datum;
        has_datum_ = !datum.isZero(0);
    }

    // The wall is where it is under the forces that the touches now hold.
    void settle_under(const std::vector<WallTouch>& touches);
    // N, of the contacts on the wall.
    const Positions& nodal_forces() const { return nodal_forces_; }

    void put(const Positions& displacement, const Positions& nodal_forces) {
        displacement_ = displacement;
        nodal_forces_ = nodal_forces;
    }

    // Moves the load to where the contact is, if it has left its place by more than `drift` of the patch's
    // radius, and turns it as the contact has turned; true if it moved.
    bool follow(WallTouch& touch, double patch, double drift) const;
    // Makes the site that belongs to the touch's anchor.
    void put_site(WallTouch& touch, double patch) const;

    // m, overlap with the unloaded wall of a sphere whose contact is `place`, its load at `site`.
    double free_overlap(const SurfaceContact& place, const ContactSite& site, const Point& centre,
                        double radius) const;
    // The same for a contact that has no site yet, the datum taken at its point.
    double free_overlap(const SurfaceContact& place, const Point& centre, double radius) const;

    // Solves all contacts; `contacts` in the order of `touches`, empty places included. Pulls are given.
    SolverReport solve(std::vector<WallTouch>& touches, std::vector<LawContact> contacts,
                       const SolverOptions& options);
    // After a solution for all, if the next comes in so many steps: what the other contacts do goes to its
    // new value by then, evenly. `before`: the touch as the step before left it. A wall that jumped there in
    // one step would hit the contacts' dashpots.
    void approach(WallTouch& touch, const WallTouch& before, int steps) const;
    // After a solution for all, if the next comes in the next step.
    void arrive(WallTouch& touch) const;
    // Between two solutions for all, this contact alone; after one, what is left between it and its law.
    void solve_alone(WallTouch& touch, LawContact contact, const SolverOptions& options) const;

    // N, what the touches' forces come to on the nodes.
    Positions loads_on_nodes(const std::vector<WallTouch>& touches) const;
    // The staggered exchange: the wall under the forces that the law found in the last step, which the
    // touches hold. Returns its gain; from 1 on it diverges.
    double exchange(const std::vector<WallTouch>& touches, const std::vector<LawContact>& contacts);

    // From here on as if read from a file.
    void forget_matrices();
    // What the contacts see of the wall as it lies.
    Point seen(const ContactSite& site) const { return site.axes * seen_displacement(site, displacement_); }

private:
    void draw_out(const std::vector<WallTouch>& touches, std::vector<LawContact>& contacts) const;
    Point unloaded_point(const SurfaceContact& place) const { return point_of(place, unloaded_); }
    Point point_of(const SurfaceContact& place, const Positions& field) const;
    void bear(const Sites& sites, const Eigen::VectorXd& forces);

    std::unique_ptr<WallModel> model_; // at a fixed address: solver_ refers to it
    Positions unloaded_, displacement_, nodal_forces_, datum_;
    bool has_datum_ = false;
    std::vector<double> face_sizes_; // m
    std::unique_ptr<WallSolver> solver_;
};

} // namespace grainfall::femlink

// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/core/wall_contacts.hpp>

#include <femlink/core/staggered.hpp>
#include <femlink/core/wall_solver.hpp>

#include <algorithm>

namespace grainfall::femlink {

namespace {

void put_axes(WallTouch& touch) {
    const Eigen::Matrix3d axes = contact_axes(touch.anchor.normal);
    touch.site.axes = axes;
    touch.own = axes.transpose() * touch.own_in_space * axes;
}

std::pair<Sites, Eigen::VectorXd> loads(const std::vector<WallTouch>& touches) {
    Sites sites;
    Eigen::VectorXd forces(3 * touches.size());
    sites.reserve(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i) {
        sites.push_back(&touches[i].site);
        forces.segment<3>(3 * i) = touches[i].whole_force();
    }
    return {std::move(sites), std::move(forces)};
}

} // namespace

QuasiStaticWall::QuasiStaticWall(WallModel model)
    : model_(std::make_unique<WallModel>(std::move(model))),
      unloaded_(model_->surface.nodes + model_->preload),
      displacement_(Positions::Zero(3, model_->surface.node_count())), nodal_forces_(displacement_),
      datum_(displacement_), solver_(std::make_unique<WallSolver>(model_->surface, model_->compliance)) {
    for (int face = 0; face < surface().face_count(); ++face)
        face_sizes_.push_back(face_size(surface(), unloaded_, face));
}
QuasiStaticWall::QuasiStaticWall(QuasiStaticWall&&) noexcept = default;
QuasiStaticWall::~QuasiStaticWall() = default;

void QuasiStaticWall::settle_under(const std::vector<WallTouch>& touches) {
    auto [sites, forces] = loads(touches);
    bear(sites, forces);
    put_datum(displacement_);
}

bool QuasiStaticWall::follow(WallTouch& touch, double patch, double drift) const {
    const double allowed = drift * patch * face_sizes_[static_cast<std::size_t>(touch.place.face)];
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

void QuasiStaticWall::put_site(WallTouch& touch, double patch) const {
    const double radius = patch * face_sizes_[static_cast<std::size_t>(touch.anchor.face)];
    touch.site.patch = contact_patch(surface(), unloaded_, touch.anchor.face, touch.anchor.at, radius);
    touch.own_in_space = patch_compliance(surface(), model_->compliance, touch.site.patch);
    put_axes(touch);
}

double QuasiStaticWall::free_overlap(const SurfaceContact& place, const ContactSite& site,
                                     const Point& centre, double radius) const {
    const double overlap = radius - place.normal.dot(centre - unloaded_point(place));
    return has_datum_ ? overlap - seen_displacement(site, datum_)[0] : overlap;
}

double QuasiStaticWall::free_overlap(const SurfaceContact& place, const Point& centre, double radius) const {
    Point here = unloaded_point(place);
    if (has_datum_)
        here -= point_of(place, datum_);
    return radius - place.normal.dot(centre - here);
}

SolverReport QuasiStaticWall::solve(std::vector<WallTouch>& touches, std::vector<LawContact> contacts,
                                    const SolverOptions& options) {
    draw_out(touches, contacts);
    auto [sites, forces] = loads(touches);
    std::vector<Eigen::Matrix3d> own;
    own.reserve(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i) {
        own.push_back(touches[i].own);
        forces.segment<3>(3 * i) = touches[i].solved + touches[i].trend;
    }
    const SolverReport report = solver_->solve(sites, own, contacts, forces, options);
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

void QuasiStaticWall::approach(WallTouch& touch, const WallTouch& before, int steps) const {
    touch.seen = seen(touch.site);
    touch.drift = touch.site.axes * (touch.others() - before.others()) / steps;
    touch.seen = before.seen;
    touch.force = before.force;
}

void QuasiStaticWall::arrive(WallTouch& touch) const {
    touch.seen = seen(touch.site);
    touch.drift.setZero();
}

void QuasiStaticWall::solve_alone(WallTouch& touch, LawContact contact, const SolverOptions& options) const {
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

Positions QuasiStaticWall::loads_on_nodes(const std::vector<WallTouch>& touches) const {
    const auto [sites, forces] = loads(touches);
    return femlink::nodal_forces(surface(), sites, forces);
}

double QuasiStaticWall::exchange(const std::vector<WallTouch>& touches,
                                 const std::vector<LawContact>& contacts) {
    const auto [sites, forces] = loads(touches);
    const double gain = staggered_gain(solver_->condense(sites), contacts);
    bear(sites, forces);
    return gain;
}

void QuasiStaticWall::forget_matrices() {
    solver_->forget();
}

// The contacts on the wall as the pulls leave it.
void QuasiStaticWall::draw_out(const std::vector<WallTouch>& touches,
                               std::vector<LawContact>& contacts) const {
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

// Interpolates a field on the nodes.
Point QuasiStaticWall::point_of(const SurfaceContact& place, const Positions& field) const {
    const Surface& s = surface();
    return s.degree == 1 ? face_frame<1>(s.face<1>(place.face, field), place.at).y
                         : face_frame<2>(s.face<2>(place.face, field), place.at).y;
}

void QuasiStaticWall::bear(const Sites& sites, const Eigen::VectorXd& forces) {
    nodal_forces_ = femlink::nodal_forces(surface(), sites, forces);
    displacement_ = displacements(surface(), model_->compliance, nodal_forces_);
}

} // namespace grainfall::femlink

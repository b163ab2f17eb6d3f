// SPDX-License-Identifier: GPL-2.0-or-later
// What is kept of a wall with its scene, and what Python reads of it.
#include <femlink/yade/FemWall.hpp>

#include <femlink/explicit/explicit_continuum.hpp>

#include <core/InteractionContainer.hpp>
#include <core/Scene.hpp>

#include <stdexcept>

namespace yade {

namespace fl = grainfall::femlink;

namespace {

boost::python::list points(const fl::Positions& columns, const Vector3r& offset = Vector3r::Zero()) {
    boost::python::list out;
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
        out.append(Vector3r(columns.col(i) + offset));
    return out;
}

const fl::QuasiStaticWall& loaded(const std::unique_ptr<fl::QuasiStaticWall>& wall) {
    if (!wall)
        throw std::runtime_error("FemWall.file = '': must be a wall file");
    return *wall;
}

} // namespace

vector<Vector3r> FemWall::by_node(const fl::Positions& columns) {
    vector<Vector3r> list;
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
        list.push_back(columns.col(i));
    return list;
}

void FemWall::postLoad(FemWall&) {
    validate();
    wall_.reset();
    if (continuum) {
        fl::WallModel model;
        model.surface = continuum->continuum().surface();
        model.preload = fl::Positions::Zero(3, model.surface.node_count());
        wall_ = std::make_unique<fl::QuasiStaticWall>(std::move(model));
        restore();
        return;
    }
    if (file.empty())
        return;
    fl::WallModel model = fl::load_wall(file);
    if (key.empty())
        key = model.key;
    else if (model.key != key)
        throw std::runtime_error("FemWall.file = '" + file + "': it holds wall " + model.key +
                                 ", the scene was made with " + key);
    wall_ = std::make_unique<fl::QuasiStaticWall>(std::move(model));
    restore();
}

/// From what preSave has kept; interactions follow with the first look at the scene.
void FemWall::restore() {
    touches_.clear();
    partners_.clear();
    const auto columns = [&](const vector<Vector3r>& list) {
        fl::Positions out = fl::Positions::Zero(3, wall_->surface().node_count());
        for (size_t i = 0; i < list.size() && i < static_cast<size_t>(out.cols()); ++i)
            out.col(static_cast<Eigen::Index>(i)) = list[i];
        return out;
    };
    wall_->put(columns(savedDisplacement), columns(savedForces));
    wall_->put_datum(columns(datum));
    glide_start_ = columns(savedGlideStart);
    load_sum_ = columns(savedLoadSum);
    restored_ = true;
    for (size_t i = 0; i < savedTouches.size() && i < savedNumbers.size(); ++i) {
        fl::WallTouch touch;
        Partner partner;
        const vector<Real>& numbers = savedNumbers[i];
        touch.sphere = savedTouches[i][0];
        if (!touch.is_empty() && numbers.size() == 17) {
            const auto three = [&](size_t at) {
                return Vector3r(numbers[at], numbers[at + 1], numbers[at + 2]);
            };
            touch.place.face = savedTouches[i][1];
            touch.anchor.face = savedTouches[i][2];
            touch.anchor.at = {numbers[0], numbers[1]};
            touch.anchor.normal = three(2);
            wall_->put_site(touch, patch);
            touch.force = three(5);
            touch.forget_course();
            touch.seen = three(8);
            touch.drift = three(11);
            partner.velocity = three(14);
        }
        touches_.push_back(touch);
        partners_.push_back(partner);
    }
}

void FemWall::preSave(FemWall&) {
    savedDisplacement.clear();
    savedForces.clear();
    savedTouches.clear();
    savedNumbers.clear();
    if (!wall_)
        return;
    savedGlideStart = by_node(glide_start_);
    savedLoadSum = by_node(load_sum_);
    // So that this run goes on as the saved one will, to the last bit.
    wall_->forget_matrices();
    for (fl::WallTouch& touch : touches_)
        touch.forget_course();
    savedDisplacement = by_node(wall_->displacement());
    savedForces = by_node(wall_->nodal_forces());
    for (size_t i = 0; i < touches_.size(); ++i) {
        const fl::WallTouch& touch = touches_[i];
        savedTouches.emplace_back(touch.sphere, touch.place.face, touch.anchor.face);
        vector<Real> numbers = {touch.anchor.at[0], touch.anchor.at[1]};
        for (const Vector3r& three :
             {touch.anchor.normal, Vector3r(touch.force), touch.seen, touch.drift, partners_[i].velocity})
            numbers.insert(numbers.end(), three.data(), three.data() + 3);
        savedNumbers.push_back(numbers);
    }
}

/// Of the touches that a file has brought back.
void FemWall::find_interactions() {
    for (size_t i = 0; i < touches_.size(); ++i)
        if (!touches_[i].is_empty())
            partners_[i].contact = scene->interactions->find(
                faces[static_cast<size_t>(touches_[i].place.face)], touches_[i].sphere);
    restored_ = false;
}

boost::python::list FemWall::node_positions() {
    return points(loaded(wall_).positions(), shift);
}

boost::python::list FemWall::node_displacements() {
    return points(loaded(wall_).displacement());
}

boost::python::list FemWall::node_forces() {
    const fl::QuasiStaticWall& wall = loaded(wall_);
    return points(continuum ? wall.nodal_forces() : wall.loads_on_nodes(touches_));
}

boost::python::list FemWall::face_nodes() {
    boost::python::list out;
    const fl::Surface& surface = loaded(wall_).surface();
    for (int face = 0; face < surface.face_count(); ++face) {
        boost::python::list nodes;
        for (Eigen::Index k = 0; k < surface.faces.rows(); ++k)
            nodes.append(surface.faces(k, face));
        out.append(nodes);
    }
    return out;
}

boost::python::list FemWall::touches_now() {
    boost::python::list out;
    for (size_t i = 0; i < touches_.size(); ++i) {
        const fl::WallTouch& touch = touches_[i];
        if (touch.is_empty() || !partners_[i].sphere)
            continue;
        const FaceTouch seen = face_touch(i);
        boost::python::dict one;
        one["sphere"] = touch.sphere;
        one["face"] = faces[static_cast<size_t>(touch.place.face)];
        one["reference"] = boost::python::make_tuple(touch.place.at[0], touch.place.at[1]);
        one["point"] = seen.point;
        one["normal"] = seen.normal;
        one["overlap"] = seen.overlap;
        one["force"] = Vector3r(touch.site.axes * touch.force);
        one["displacement"] = touch.seen;
        out.append(one);
    }
    return out;
}

} // namespace yade

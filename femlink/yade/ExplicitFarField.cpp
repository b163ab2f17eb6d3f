// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/ExplicitFarField.hpp>

#include <femlink/explicit/explicit_continuum.hpp>

#include <stdexcept>

namespace yade {

YADE_PLUGIN((ExplicitFarField));

namespace fl = grainfall::femlink;

namespace {

fl::HexMesh mesh_of(const ExplicitFarField& field) {
    using grainfall::laws::reject;
    if (field.cells.size() % 8 != 0)
        reject("ExplicitFarField.cells", static_cast<double>(field.cells.size()), "8 numbers a cell");
    if (field.boundary.size() % 5 != 0)
        reject("ExplicitFarField.boundary", static_cast<double>(field.boundary.size()), "5 numbers a face");
    fl::HexMesh mesh;
    mesh.vertices.assign(field.vertices.begin(), field.vertices.end());
    mesh.regions = field.regions;
    for (size_t i = 0; i < field.cells.size(); i += 8) {
        std::array<int, 8> cell;
        std::copy_n(field.cells.begin() + static_cast<long>(i), 8, cell.begin());
        mesh.cells.push_back(cell);
    }
    for (size_t i = 0; i < field.boundary.size(); i += 5) {
        fl::HexMesh::BoundaryFace face;
        std::copy_n(field.boundary.begin() + static_cast<long>(i), 4, face.corners.begin());
        face.id = field.boundary[i + 4];
        mesh.boundary.push_back(face);
    }
    return mesh;
}

fl::SolidMaterials solids_of(const ExplicitFarField& field) {
    constexpr size_t numbers = 10;
    if (field.solids.size() % numbers != 0)
        grainfall::laws::reject("ExplicitFarField.solids", static_cast<double>(field.solids.size()),
                                "10 numbers a region");
    fl::SolidMaterials solids;
    for (size_t i = 0; i < field.solids.size(); i += numbers) {
        const Real* s = &field.solids[i];
        const int region = static_cast<int>(s[0]);
        fl::SolidMaterial solid{static_cast<fl::SolidLaw>(static_cast<int>(s[1])),
                                {s[2], s[3], s[4]},
                                s[5],
                                s[6],
                                s[7],
                                s[8],
                                s[9]};
        fl::validate(solid, "solids[" + std::to_string(region) + "]");
        solids[region] = solid;
    }
    return solids;
}

} // namespace

void ExplicitFarField::postLoad(ExplicitFarField&) {
    continuum_.reset();
    if (vertices.empty())
        return;
    fl::ExplicitOptions options;
    options.element = fl::element_kind_from_name("ExplicitFarField.element", element);
    options.outer = fl::outer_boundary_from_name("ExplicitFarField.outer", outer);
    options.safety = safety;
    options.hourglass = hourglass;
    options.gravity = gravity;
    continuum_ = std::make_shared<fl::ExplicitContinuum>(mesh_of(*this), solids_of(*this), options);
    if (continuum_->surface().face_count() == 0)
        grainfall::laws::reject("ExplicitFarField.boundary", "no coupling face", "at least one of id 2");
    if (!savedState.empty())
        continuum_->set_state(savedState);
}

void ExplicitFarField::preSave(ExplicitFarField&) {
    savedState = continuum_ ? continuum_->state() : vector<Real>();
}

fl::ExplicitContinuum& ExplicitFarField::continuum() {
    if (!continuum_)
        throw std::runtime_error("ExplicitFarField.vertices = []: must be those of a mesh; make walls with "
                                 "grainfall.femlink.add_explicit_wall");
    return *continuum_;
}

Real ExplicitFarField::critical_step() {
    return continuum().critical_step();
}

long ExplicitFarField::substeps() {
    return continuum().substeps();
}

boost::python::dict ExplicitFarField::energies() {
    const fl::ExplicitEnergies now = continuum().energies();
    boost::python::dict out;
    out["kinetic"] = now.kinetic;
    out["elastic"] = now.elastic;
    out["hourglass"] = now.hourglass;
    out["plastic"] = now.plastic;
    out["absorbed"] = now.absorbed;
    out["ground"] = now.ground;
    out["surfaceWork"] = now.surface_work;
    return out;
}

boost::python::list ExplicitFarField::state_now() {
    boost::python::list out;
    for (const Real number : continuum().state())
        out.append(number);
    return out;
}

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
#include "femlink_flat_wall.hpp"

#include <gtest/gtest.h>

namespace {

using namespace grainfall::femlink;

constexpr double h = 0.01; // m, face

struct Resultant {
    Point force = Point::Zero(), moment = Point::Zero();
};

Resultant resultant(const ContactPatch& patch, const Positions& positions, const Point& force) {
    Resultant sum;
    for (std::size_t a = 0; a < patch.nodes.size(); ++a) {
        const Point at_node = patch.block(a) * force;
        sum.force += at_node;
        sum.moment += positions.col(patch.nodes[a]).cross(at_node);
    }
    return sum;
}

void conserves(const Surface& surface, const Positions& positions, int face, const Reference& at,
               double radius) {
    const Point force(3, -2, 5);
    const Point place = face_point<1>(surface.face<1>(face, positions), at);
    const Resultant sum = resultant(contact_patch(surface, positions, face, at, radius), positions, force);
    EXPECT_LT((sum.force - force).norm(), 1e-14 * force.norm()) << at.transpose();
    EXPECT_LT((sum.moment - place.cross(force)).norm(), 1e-12 * place.norm() * force.norm())
        << at.transpose();
}

TEST(ContactPatch, carries_force_and_moment_to_rounding_on_a_flat_surface_and_at_its_rim) {
    const FlatWall wall(8, h);
    for (const int face : {0, 7, 27, 63})
        for (const double x : {-1.0, 0.2, 1.0})
            for (const double y : {-1.0, 0.999})
                for (const double radius : {0.0, 1.25 * h, 3 * h})
                    conserves(wall.surface, wall.surface.nodes, face, {x, y}, radius);
}

TEST(ContactPatch, carries_force_and_moment_to_rounding_on_a_wavy_surface) {
    const FlatWall wall(8, h);
    Positions wavy = wall.surface.nodes;
    for (Eigen::Index k = 0; k < wavy.cols(); ++k)
        wavy(2, k) = 0.2 * h * std::sin(150 * wavy(0, k) + 90 * wavy(1, k));
    for (const int face : {0, 9, 27, 36, 63})
        for (const double x : {-0.9, 0.0, 0.4})
            for (const double radius : {0.0, 1.25 * h, 2 * h})
                conserves(wall.surface, wavy, face, {x, 0.3}, radius);
}

TEST(ContactPatch, sees_a_rigid_motion_as_it_is) {
    const FlatWall wall(8, h);
    Positions wavy = wall.surface.nodes;
    for (Eigen::Index k = 0; k < wavy.cols(); ++k)
        wavy(2, k) = 0.1 * h * std::sin(150 * wavy(0, k) + 90 * wavy(1, k));
    const Point shift(1e-4, -2e-4, 3e-4), turn(0.01, -0.02, 0.03);
    Positions motion(3, wavy.cols());
    for (Eigen::Index k = 0; k < wavy.cols(); ++k)
        motion.col(k) = shift + turn.cross(Point(wavy.col(k)));
    const Reference at(0.3, -0.4);
    const ContactSite site{contact_patch(wall.surface, wavy, 27, at, 1.25 * h), Eigen::Matrix3d::Identity()};
    const Point place = face_point<1>(wall.surface.face<1>(27, wavy), at);
    EXPECT_LT((seen_displacement(site, motion) - shift - turn.cross(place)).norm(), 1e-15);
}

TEST(ContactPatch, of_a_point_load_is_the_shape_functions) {
    const FlatWall wall(4, h);
    const ContactPatch patch = contact_patch(wall.surface, wall.surface.nodes, 5, {-0.5, 0.5}, 0);
    ASSERT_EQ(patch.nodes.size(), 4u);
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(patch.weights[k], shape_values<1>({-0.5, 0.5})[k], 1e-15);
}

TEST(ContactPatch, does_not_run_over_a_sharp_edge) {
    // Floor and wall of a cavity: two faces that share the edge x = h, at a right angle.
    Surface corner;
    corner.nodes.resize(3, 6);
    corner.nodes << 0, h, 0, h, h, h, 0, 0, h, h, 0, h, 0, 0, 0, 0, h, h;
    corner.faces.resize(4, 2);
    corner.faces << 0, 1, 1, 4, 2, 3, 3, 5;
    corner.loose = {0, 1, 2, 3, 4, 5};
    corner.connect();
    ASSERT_EQ(corner.neighbours[0][1], 1);
    const ContactPatch patch = contact_patch(corner, corner.nodes, 0, {0.5, 0}, h);
    for (const int node : patch.nodes)
        EXPECT_LT(node, 4);
    EXPECT_TRUE(patch.is_flat()); // still centred on the contact
    conserves(corner, corner.nodes, 0, {0.5, 0}, h);
}

double ripple(const FlatWall& wall, double patch) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int i = 0; i <= 3; ++i) {
        for (int j = 0; j <= 3; ++j) {
            LoadedCompliance loaded(wall.surface, wall.compliance);
            const double compliance = loaded.condense({wall.site(h * i / 6.0, h * j / 6.0, patch)})(0, 0);
            least = std::min(least, compliance);
            most = std::max(most, compliance);
        }
    }
    return most / least;
}

// A node under a point load gives way more than a face's middle; over a disc the difference fades.
TEST(ContactPatch, makes_the_compliance_nearly_the_same_all_over_a_face) {
    const FlatWall wall(10, h);
    EXPECT_GT(ripple(wall, 0), 1.5);
    EXPECT_LT(ripple(wall, 1.0 * h), 1.04);
    EXPECT_LT(ripple(wall, 1.5 * h), 1.02);
}

// The shape functions widen the disc: along each axis they add h^2/6 to its variance R^2/4, so it acts as one
// of radius sqrt(R^2 + 2/3 h^2). What is left is the nodes' own compliance, a guess here; its share falls as
// (h/R)^2.
TEST(ContactPatch, of_several_faces_gives_way_as_a_uniformly_loaded_disc_does) {
    const HalfSpace ground;
    const FlatWall wall(12, h, ground);
    for (const double radius : {3 * h, 4 * h}) {
        LoadedCompliance loaded(wall.surface, wall.compliance);
        const double compliance = loaded.condense({wall.site(0.2 * h, 0.3 * h, radius)})(0, 0);
        const double widened = std::sqrt(radius * radius + 2 * h * h / 3);
        EXPECT_NEAR(compliance / disc_compliance(ground.young, ground.poisson, widened), 1,
                    0.4 * h * h / radius / radius);
    }
}

TEST(LoadedCompliance, is_symmetric_and_does_not_depend_on_what_was_loaded_before) {
    const FlatWall wall(10, h);
    const ContactSite here = wall.site(0, 0, 1.25 * h), there = wall.site(0.03, 0.02, 1.25 * h),
                      nearby = wall.site(0.001, 0, 1.25 * h), elsewhere = wall.site(-0.03, 0.02, 0);
    ContactSite none;
    none.axes = Eigen::Matrix3d::Identity();
    LoadedCompliance used(wall.surface, wall.compliance);
    // One moves, one stays; one is added; two change places; one is taken out; all but one go.
    for (const std::vector<ContactSite>& sites :
         std::vector<std::vector<ContactSite>>{{here, there},
                                               {nearby, there},
                                               {nearby, there, elsewhere},
                                               {there, nearby, elsewhere},
                                               {there, none, elsewhere},
                                               {there}}) {
        LoadedCompliance fresh(wall.surface, wall.compliance);
        const Eigen::MatrixXd expected = fresh.condense(sites), found = used.condense(sites);
        EXPECT_LT((found - expected).norm(), 1e-15 * expected.norm());
        EXPECT_LT((found - found.transpose()).norm(), 1e-15 * expected.norm());
    }
}

TEST(LoadedCompliance, is_the_displacement_that_the_contacts_see_under_their_own_forces) {
    const FlatWall wall(10, h);
    const std::vector<ContactSite> sites = {wall.site(0, 0, 1.25 * h), wall.site(0.03, 0.02, h),
                                            wall.site(0.05, 0.05, h)};
    Eigen::VectorXd forces(9);
    forces << 3, 1, -1, 2, 0.5, 0.2, 4, -1, 1;
    LoadedCompliance loaded(wall.surface, wall.compliance);
    const Eigen::VectorXd yielded = loaded.condense(sites) * forces;
    const Positions nodal = nodal_forces(wall.surface, sites, forces);
    const Positions moved = displacements(wall.surface, wall.compliance, nodal);
    double work = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const Eigen::Vector3d seen = seen_displacement(sites[i], moved);
        EXPECT_LT((seen + yielded.segment<3>(3 * i)).norm(), 1e-14 * yielded.norm());
        work -= seen.dot(forces.segment<3>(3 * i));
    }
    // The work of the contacts is the work on the nodes.
    EXPECT_NEAR(work, (nodal.array() * moved.array()).sum(), 1e-14 * work);
}

} // namespace

// SPDX-License-Identifier: GPL-3.0-or-later
// M. Alexa, W. Müller, "Representing animations by principal components", Computer Graphics Forum 19 (2000) 411.
//
// The changes of all vertices over time are a matrix with three rows for each vertex, three for its normal, and a
// column for each shape, all over their tolerances. Its principal components over time are few columns; what a vertex
// does is a sum of them. Vertices are independent once these are known, so each tells how many components it needs.
//
// Weights of components have both signs, but Blender's shape keys stop at 0 and 1. One more change, the sum of all
// others backwards, makes them positive: its weight is what the least of the others lacks, and is added to all of them.
#include "flow_io/shape_basis.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace droplet {
namespace {

// Normals where a mesh folds turn as no few components do, and few see them.
constexpr double kNearlyAll = 0.99;

using Changes = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Changes of a vertex and its normal from the first shape, over their tolerances.
Changes changesOf(const std::vector<MeshShape>& shapes, std::size_t v, const ShapeTolerance& tolerance)
{
    Changes changes(6, static_cast<Eigen::Index>(shapes.size()));
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        const Vec3 p = (1.0 / tolerance.vertices) * (shapes[k].vertices[v] - shapes[0].vertices[v]);
        const Vec3 n = (1.0 / tolerance.normals) * (shapes[k].normals[v] - shapes[0].normals[v]);
        changes.col(static_cast<Eigen::Index>(k)) << p.x, p.y, p.z, n.x, n.y, n.z;
    }
    return changes;
}

/// Principal components over time, the largest first.
Eigen::MatrixXd componentsOf(const std::vector<MeshShape>& shapes, const ShapeTolerance& tolerance)
{
    constexpr std::size_t kMostSampled = 5000;  // enough to tell what bones there are
    const std::size_t vertices = shapes[0].vertices.size();
    const std::size_t stride = std::max<std::size_t>(vertices / kMostSampled, 1);
    const auto count = static_cast<Eigen::Index>(shapes.size());
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
    for (std::size_t v = 0; v < vertices; v += stride) {
        const Changes changes = changesOf(shapes, v, tolerance);
        products.noalias() += changes.transpose() * changes;
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(products).eigenvectors().rowwise().reverse();
}

/// Numbers of components within which a vertex, and its normal, are off by no more than their tolerances.
struct Needed {
    Eigen::Index vertex = 0;
    Eigen::Index normal = 0;
};

Needed componentsFor(Changes rest, const Eigen::MatrixXd& components)
{
    constexpr double kAllowed = 1.0 + 1e-9;  // rounding
    Needed needed;
    for (Eigen::Index used = 0;; ++used) {
        const bool is_vertex_off = rest.topRows<3>().colwise().squaredNorm().maxCoeff() > kAllowed;
        const bool is_normal_off = rest.bottomRows<3>().colwise().squaredNorm().maxCoeff() > kAllowed;
        needed.vertex = is_vertex_off ? used + 1 : needed.vertex;
        needed.normal = is_normal_off ? used + 1 : needed.normal;
        if (used == components.cols() || !(is_vertex_off || is_normal_off)) {
            return {std::min(needed.vertex, components.cols()), std::min(needed.normal, components.cols())};
        }
        const Eigen::Matrix<double, 6, 1> share = rest * components.col(used);
        rest.noalias() -= share * components.col(used).transpose();
    }
}

/// Number of components for all vertices, and for nearly all normals.
Eigen::Index componentsFor(const std::vector<MeshShape>& shapes, const ShapeTolerance& tolerance,
                           const Eigen::MatrixXd& components)
{
    const std::size_t vertices = shapes[0].vertices.size();
    std::vector<Needed> needed(vertices);
    tbb::parallel_for(std::size_t{0}, vertices,
                      [&](std::size_t v) { needed[v] = componentsFor(changesOf(shapes, v, tolerance), components); });
    std::vector<Eigen::Index> normals;
    Eigen::Index most = 0;
    for (const auto& [vertex, normal] : needed) {
        most = std::max(most, vertex);
        normals.push_back(normal);
    }
    const auto worst = normals.begin() + static_cast<std::ptrdiff_t>(kNearlyAll * static_cast<double>(vertices - 1));
    std::nth_element(normals.begin(), worst, normals.end());
    return std::max(most, *worst);
}

}  // namespace

ShapeBasis shapeBasis(const std::vector<MeshShape>& shapes, const ShapeTolerance& tolerance)
{
    const std::size_t vertices = shapes[0].vertices.size();
    const Eigen::MatrixXd components = componentsOf(shapes, tolerance);
    const Eigen::Index needed = componentsFor(shapes, tolerance, components);
    ShapeBasis basis;
    basis.weights.resize(shapes.size());
    if (needed == 0) {
        return basis;
    }
    const Eigen::VectorXd largest = components.cwiseAbs().colwise().maxCoeff().transpose();
    for (Eigen::Index k = 0; k < components.rows(); ++k) {
        const Eigen::VectorXd weights =
            0.5 * components.row(k).head(needed).transpose().cwiseQuotient(largest.head(needed));
        const double lift = std::max(-weights.minCoeff(), 0.0);
        std::vector<double>& lifted = basis.weights[static_cast<std::size_t>(k)];
        for (Eigen::Index c = 0; c < needed; ++c) {
            lifted.push_back(weights(c) + lift);
        }
        lifted.push_back(lift);
    }
    basis.changes.assign(static_cast<std::size_t>(needed) + 1,
                         {std::vector<Vec3>(vertices), std::vector<Vec3>(vertices)});
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
        const Changes changes = changesOf(shapes, v, tolerance);
        MeshShape& back = basis.changes.back();
        for (Eigen::Index c = 0; c < needed; ++c) {
            const Eigen::Matrix<double, 6, 1> share = 2.0 * largest(c) * (changes * components.col(c));
            MeshShape& change = basis.changes[static_cast<std::size_t>(c)];
            change.vertices[v] = tolerance.vertices * Vec3{share(0), share(1), share(2)};
            change.normals[v] = tolerance.normals * Vec3{share(3), share(4), share(5)};
            back.vertices[v] = back.vertices[v] - change.vertices[v];
            back.normals[v] = back.normals[v] - change.normals[v];
        }
    });
    return basis;
}

}  // namespace droplet

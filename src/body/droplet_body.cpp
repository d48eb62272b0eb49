// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/body/droplet_body.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "body/body_grid.h"
#include "body/capillary_body.h"
#include "body/capsule_body.h"
#include "body/spring_body.h"
#include "droplet/body/running_shape.h"
#include "droplet/error.h"
#include "require.h"

namespace droplet {

namespace {

/// Capsules of the thesis.
class CapsuleBody {
public:
    explicit CapsuleBody(const ForceModel& model) { options_.contact_angle = model.wetting.contact_angle; }

    [[nodiscard]] BodyGrid shape(const BodyConditions& conditions) const
    {
        return capsuleGrid(runningShape(conditions.volume, conditions.speed, options_));
    }

private:
    ShapeOptions options_;
};

using AnyBody = std::variant<CapillaryBody, SpringBody, CapsuleBody>;

AnyBody bodyOf(BodyShape shape, const ForceModel& model)
{
    model.validate();
    switch (shape) {
        case BodyShape::Capillary:
            return CapillaryBody(model);
        case BodyShape::Springs:
            return SpringBody(model);
        case BodyShape::Capsule:
            return CapsuleBody(model);
    }
    throw Error(ErrorCode::InvalidArgument, "shape must be capillary, springs or capsule");
}

}  // namespace

struct DropletBodies::Content {
    struct OfAngle {
        double contact_angle;
        AnyBody body;
    };
    std::vector<OfAngle> bodies = {};  ///< that of the force model first
    std::vector<Triangle> triangles = bodyTriangles();

    [[nodiscard]] const AnyBody& bodyAt(std::optional<double> angle) const
    {
        const auto nearer = [&](const OfAngle& a, const OfAngle& b) {
            return std::abs(a.contact_angle - *angle) < std::abs(b.contact_angle - *angle);
        };
        return angle ? std::min_element(bodies.begin(), bodies.end(), nearer)->body : bodies.front().body;
    }
};

DropletBodies::DropletBodies(BodyShape shape, const ForceModel& model, std::span<const double> contact_angles)
    : content_(std::make_unique<Content>())
{
    ForceModel of_angle = model;
    content_->bodies.push_back({model.wetting.contact_angle, bodyOf(shape, model)});
    for (const double angle : contact_angles) {
        of_angle.wetting.contact_angle = angle;
        content_->bodies.push_back({angle, bodyOf(shape, of_angle)});
    }
}

DropletBodies::~DropletBodies() = default;
DropletBodies::DropletBodies(DropletBodies&&) noexcept = default;
DropletBodies& DropletBodies::operator=(DropletBodies&&) noexcept = default;

std::size_t DropletBodies::vertices() const
{
    return kBodyVertices;
}

std::size_t DropletBodies::rimVertices() const
{
    return kBodySlices;
}

const std::vector<Triangle>& DropletBodies::triangles() const
{
    return content_->triangles;
}

void DropletBodies::make(const BodyConditions& conditions, std::span<Vec3> vertices, std::span<Vec3> normals) const
{
    require(conditions.volume > 0.0 && std::isfinite(conditions.volume), "volume", conditions.volume,
            "finite and more than 0 m3");
    require(conditions.speed >= 0.0 && std::isfinite(conditions.speed), "speed", conditions.speed,
            "finite and at least 0 m/s");
    const double gravity = length(conditions.gravity);
    require(std::isfinite(gravity), "gravity", gravity, "finite");
    require(vertices.size() == kBodyVertices, "vertices.size", vertices.size(), "the number of vertices");
    require(normals.size() == kBodyVertices, "normals.size", normals.size(), "the number of vertices");
    if (conditions.airborne) {
        makeBall(conditions.volume, vertices, normals);
        return;
    }
    BodyGrid grid = std::visit([&](const auto& body) { return body.shape(conditions); },
                               content_->bodyAt(conditions.contact_angle));
    finish(grid, conditions.volume, vertices, normals);
}

}  // namespace droplet

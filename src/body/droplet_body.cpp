// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/body/droplet_body.h"

#include <cmath>
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
    AnyBody body;
    std::vector<Triangle> triangles = bodyTriangles();
};

DropletBodies::DropletBodies(BodyShape shape, const ForceModel& model)
    : content_(std::make_unique<Content>(Content{.body = bodyOf(shape, model)}))
{
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
    BodyGrid grid = std::visit([&](const auto& body) { return body.shape(conditions); }, content_->body);
    finish(grid, conditions.volume, vertices, normals);
}

}  // namespace droplet

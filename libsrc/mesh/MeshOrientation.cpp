#include "mesh/MeshOrientation.h"

#include "dictionary/Text.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace caisson {

namespace {

using Eigen::Vector3d;

/// Directions within this angle [rad] count as equal: more than the rounding of points written with six
/// digits; whether each point lies where it should is checked apart from this.
constexpr double directionTolerance = 1e-3;

bool parallel(const Vector3d& a, const Vector3d& b) { return a.cross(b).norm() < directionTolerance; }

std::string print(const Vector3d& v)
{
    const auto clean = [](double x) { return std::abs(x) < 1e-9 ? 0.0 : x; };
    return text("(%.9g %.9g %.9g)", clean(v.x()), clean(v.y()), clean(v.z()));
}

std::string rotate(const Vector3d& from, const Vector3d& to)
{
    return "transformPoints -rotate '(" + print(from) + " " + print(to) + ")'";
}

std::optional<OrientationProblem> checkWedge(const Vector3d& first, const Vector3d& second)
{
    Vector3d axis = first.cross(second);
    if (axis.norm() < directionTolerance) {
        return OrientationProblem{"the wedge patches are parallel planes",
                                  "for plane strain give both patches the type empty; for an axisymmetric "
                                  "case make a wedge (extrudeMesh with extrudeModel wedge, or blockMesh)"};
    }
    axis.normalize();
    int largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    if (axis[largest] < 0) {
        axis = -axis;
    }
    Vector3d radial = -(first + second).normalized();

    std::string commands;
    if (!parallel(axis, Vector3d::UnitZ())) {
        commands = rotate(axis, Vector3d::UnitZ());
        radial = Eigen::Quaterniond::FromTwoVectors(axis, Vector3d::UnitZ()) * radial;
    }
    const double angle = std::atan2(radial.y(), radial.x());
    if (std::abs(angle) > directionTolerance) {
        commands += text("%stransformPoints -rotate-angle '((0 0 1) %.9g)'", commands.empty() ? "" : " && ",
                         -angle * 180 / std::numbers::pi);
    }
    if (commands.empty()) {
        return std::nullopt;
    }
    const std::string seen =
        parallel(axis, Vector3d::UnitZ())
            ? text("its middle plane is turned by %.6g degrees about z", angle * 180 / std::numbers::pi)
            : "its axis has the direction " + print(axis);
    return OrientationProblem{
        "the wedge must have its axis along z (upward) and lie symmetric about y = 0, r = x; " + seen,
        commands};
}

std::optional<OrientationProblem> checkPlane(const Vector3d& first, const Vector3d& second)
{
    if (!parallel(first, second)) {
        return OrientationProblem{"the empty patches are not parallel planes",
                                  "for an axisymmetric case give them the type wedge; for plane strain make "
                                  "one layer of constant thickness"};
    }
    if (parallel(first, Vector3d::UnitY())) {
        return std::nullopt;
    }
    // A mesh drawn in the plane of x and y has y up; one drawn in the plane of y and z has z up.
    std::string command = rotate(first, Vector3d::UnitY());
    if (parallel(first, Vector3d::UnitZ())) {
        command = rotate(Vector3d::UnitY(), Vector3d::UnitZ());
    } else if (parallel(first, Vector3d::UnitX())) {
        command = rotate(Vector3d::UnitY(), Vector3d::UnitX());
    }
    return OrientationProblem{
        "the empty planes must be normal to y, with z upward; they are normal to " + print(first), command};
}

} // namespace

std::optional<OrientationProblem> checkOrientation(Geometry geometry, const std::array<double, 3>& first,
                                                   const std::array<double, 3>& second)
{
    const Vector3d a(first[0], first[1], first[2]);
    const Vector3d b(second[0], second[1], second[2]);
    return geometry == Geometry::axisymmetric ? checkWedge(a, b) : checkPlane(a, b);
}

} // namespace caisson

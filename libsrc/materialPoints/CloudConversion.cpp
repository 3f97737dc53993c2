#include "materialPoints/CloudConversion.h"

#include "dictionary/InputProblems.h"
#include "dictionary/Text.h"

#include <algorithm>
#include <stdexcept>

namespace caisson {

namespace {

/// Components of a symmTensor (xx xy xz yy yz zz) that hold the stress rr, zz, tt, rz.
constexpr std::array<int, 4> stressComponent = {0, 5, 3, 2};

template <typename Value>
NamedField interleaved(const std::string& name, FieldKind kind, std::size_t points, const Value& value)
{
    NamedField field{name, kind, {}};
    const int n = components(kind);
    field.values.resize(points * n);
    for (std::size_t p = 0; p < points; ++p) {
        for (int k = 0; k < n; ++k) {
            field.values[p * n + k] = value(p, k);
        }
    }
    return field;
}

NamedField plain(const std::string& name, const std::vector<double>& values)
{
    return {name, FieldKind::scalar, values};
}

NamedField labels(const std::string& name, const std::vector<int>& values)
{
    return {name, FieldKind::label, {values.begin(), values.end()}};
}

[[noreturn]] void fail(const Cloud& cloud, const std::string& field, const std::string& message)
{
    throw InputError("the material points",
                     {{{"lagrangian/" + cloud.name + "/" + field, 0},
                       message,
                       "run setMaterialPoints again, or restart from a time that the solver wrote"}});
}

const std::vector<double>& values(const Cloud& cloud, const std::string& name, FieldKind kind)
{
    const auto found = std::ranges::find(cloud.fields, name, &NamedField::name);
    if (found == cloud.fields.end()) {
        fail(cloud, name, "the field is missing");
    }
    if (found->kind != kind) {
        fail(cloud, name, text("the field has another kind than expected (%d components)", components(kind)));
    }
    const std::size_t expected = cloud.positions.size() * components(kind);
    if (found->values.size() != expected) {
        fail(cloud, name,
             text("the field has %zu numbers for %zu points", found->values.size(), cloud.positions.size()));
    }
    return found->values;
}

/// Component k of a field of n components.
std::vector<double> component(const std::vector<double>& values, int k, int n)
{
    std::vector<double> result(values.size() / n);
    for (std::size_t p = 0; p < result.size(); ++p) {
        result[p] = values[p * n + k];
    }
    return result;
}

std::vector<int> integers(const std::vector<double>& values) { return {values.begin(), values.end()}; }

} // namespace

Cloud cloud(const MaterialPoints& points, const std::vector<std::string>& stateNames)
{
    if (stateNames.size() != points.state.size()) {
        throw std::logic_error("cloud: as many names as state variables are needed");
    }
    const std::size_t n = points.size();
    Cloud result;
    result.cells = points.cell;
    for (std::size_t p = 0; p < n; ++p) {
        result.positions.push_back({points.r[p], 0, points.z[p]});
    }
    const auto inPlane = [](const std::vector<double>& r, const std::vector<double>& z) {
        return [&r, &z](std::size_t p, int k) { return k == 0 ? r[p] : k == 2 ? z[p] : 0; };
    };
    result.fields.push_back(interleaved("velocity", FieldKind::vector, n, inPlane(points.vr, points.vz)));
    result.fields.push_back(interleaved("stress", FieldKind::symmTensor, n, [&](std::size_t p, int k) {
        const auto found = std::ranges::find(stressComponent, k);
        return found == stressComponent.end() ? 0 : points.stress[found - stressComponent.begin()][p];
    }));
    result.fields.push_back(plain("mass", points.mass));
    result.fields.push_back(plain("volume", points.volume));
    result.fields.push_back(labels("material", points.material));
    result.fields.push_back(labels("id", points.id));
    result.fields.push_back(
        interleaved("initialPosition", FieldKind::vector, n, inPlane(points.initialR, points.initialZ)));
    if (points.twoPhase()) {
        result.fields.push_back(
            interleaved("liquidVelocity", FieldKind::vector, n, inPlane(points.wr, points.wz)));
        result.fields.push_back(plain("porePressure", points.porePressure));
    }
    if (points.affine()) {
        result.fields.push_back(interleaved("radialVelocityGradient", FieldKind::vector, n,
                                            inPlane(points.gradient[0], points.gradient[1])));
        result.fields.push_back(interleaved("verticalVelocityGradient", FieldKind::vector, n,
                                            inPlane(points.gradient[2], points.gradient[3])));
    }
    if (points.loaded()) {
        result.fields.push_back(labels("load", points.load));
        result.fields.push_back(plain("loadArea", points.loadArea));
        result.fields.push_back(
            interleaved("loadReach", FieldKind::vector, n, inPlane(points.loadReachR, points.loadReachZ)));
    }
    for (std::size_t k = 0; k < stateNames.size(); ++k) {
        result.fields.push_back(plain(stateNames[k], points.state[k]));
    }
    return result;
}

MaterialPoints materialPoints(const Cloud& cloud, const std::vector<std::string>& stateNames)
{
    MaterialPoints points;
    for (const auto& [x, y, z] : cloud.positions) {
        if (y != 0) {
            fail(cloud, "positions", text("a point at (%g %g %g) lies off the plane y = 0", x, y, z));
        }
        points.r.push_back(x);
        points.z.push_back(z);
    }
    if (cloud.cells.size() != points.size()) {
        fail(cloud, "positions", text("%zu cells for %zu points", cloud.cells.size(), points.size()));
    }
    points.cell = cloud.cells;
    const auto& velocity = values(cloud, "velocity", FieldKind::vector);
    points.vr = component(velocity, 0, 3);
    points.vz = component(velocity, 2, 3);
    const auto& stress = values(cloud, "stress", FieldKind::symmTensor);
    for (std::size_t k = 0; k < stressComponent.size(); ++k) {
        points.stress[k] = component(stress, stressComponent[k], 6);
    }
    points.mass = values(cloud, "mass", FieldKind::scalar);
    points.volume = values(cloud, "volume", FieldKind::scalar);
    points.material = integers(values(cloud, "material", FieldKind::label));
    points.id = integers(values(cloud, "id", FieldKind::label));
    const auto& initial = values(cloud, "initialPosition", FieldKind::vector);
    points.initialR = component(initial, 0, 3);
    points.initialZ = component(initial, 2, 3);
    if (std::ranges::find(cloud.fields, "porePressure", &NamedField::name) != cloud.fields.end()) {
        points.porePressure = values(cloud, "porePressure", FieldKind::scalar);
        const auto& liquid = values(cloud, "liquidVelocity", FieldKind::vector);
        points.wr = component(liquid, 0, 3);
        points.wz = component(liquid, 2, 3);
    }
    if (std::ranges::any_of(cloud.fields, [](const NamedField& field) {
            return field.name == "radialVelocityGradient" || field.name == "verticalVelocityGradient";
        })) {
        const auto& radial = values(cloud, "radialVelocityGradient", FieldKind::vector);
        const auto& vertical = values(cloud, "verticalVelocityGradient", FieldKind::vector);
        points.gradient = {component(radial, 0, 3), component(radial, 2, 3), component(vertical, 0, 3),
                           component(vertical, 2, 3)};
    }
    if (std::ranges::find(cloud.fields, "load", &NamedField::name) != cloud.fields.end()) {
        points.load = integers(values(cloud, "load", FieldKind::label));
        points.loadArea = values(cloud, "loadArea", FieldKind::scalar);
        const auto& reach = values(cloud, "loadReach", FieldKind::vector);
        points.loadReachR = component(reach, 0, 3);
        points.loadReachZ = component(reach, 2, 3);
    }
    for (const std::string& name : stateNames) {
        points.state.push_back(values(cloud, name, FieldKind::scalar));
    }
    return points;
}

} // namespace caisson

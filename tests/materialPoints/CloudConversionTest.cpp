#include "materialPoints/CloudConversion.h"

#include "dictionary/InputProblems.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <random>
#include <unistd.h>

using namespace caisson;

namespace {

const std::vector<std::string> names = {"plasticShearStrain", "tensileVolumetricStrain"};

/// Numbers with all their digits, and some that are easily lost.
MaterialPoints randomPoints(std::size_t count)
{
    MaterialPoints points;
    points.resize(count, names.size());
    std::mt19937_64 random(42);
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-60, 60);
    const auto fillNumbers = [&](std::vector<double>& values) {
        for (double& value : values) {
            value = std::ldexp(mantissa(random), exponent(random));
        }
        values[0] = -0.0;
        values[1] = 5e-324;
        values[2] = 0.1;
    };
    for (auto* values : {&points.r, &points.z, &points.vr, &points.vz, &points.mass, &points.volume,
                         &points.initialR, &points.initialZ, &points.state[0], &points.state[1]}) {
        fillNumbers(*values);
    }
    for (auto& values : points.stress) {
        fillNumbers(values);
    }
    for (auto& values : points.gradient) {
        values.resize(count);
        fillNumbers(values);
    }
    for (auto* values : {&points.cell, &points.material, &points.id}) {
        for (int& value : *values) {
            value = static_cast<int>(random() % 2147483647);
        }
    }
    return points;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void expectSame(const MaterialPoints& a, const MaterialPoints& b)
{
    EXPECT_TRUE(sameBits(a.r, b.r));
    EXPECT_TRUE(sameBits(a.z, b.z));
    EXPECT_TRUE(sameBits(a.vr, b.vr));
    EXPECT_TRUE(sameBits(a.vz, b.vz));
    EXPECT_TRUE(sameBits(a.mass, b.mass));
    for (std::size_t k = 0; k < a.gradient.size(); ++k) {
        EXPECT_TRUE(sameBits(a.gradient[k], b.gradient[k]));
    }
    EXPECT_TRUE(sameBits(a.volume, b.volume));
    for (int k = 0; k < 4; ++k) {
        EXPECT_TRUE(sameBits(a.stress[k], b.stress[k])) << "component " << k;
    }
    ASSERT_EQ(a.state.size(), b.state.size());
    for (std::size_t k = 0; k < a.state.size(); ++k) {
        EXPECT_TRUE(sameBits(a.state[k], b.state[k])) << "variable " << k;
    }
    EXPECT_TRUE(sameBits(a.initialR, b.initialR));
    EXPECT_TRUE(sameBits(a.initialZ, b.initialZ));
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.id, b.id);
}

std::string failureOf(const Cloud& cloud)
{
    try {
        materialPoints(cloud, names);
    } catch (const InputError& error) {
        return error.problems()[0].where.file + ": " + error.problems()[0].message;
    }
    return "";
}

} // namespace

TEST(CloudConversion, roundTripKeepsEveryBit)
{
    const MaterialPoints points = randomPoints(1000);
    expectSame(materialPoints(cloud(points, names), names), points);
}

TEST(CloudConversion, roundTripThroughFilesKeepsEveryBit)
{
    const MaterialPoints points = randomPoints(1000);
    const auto folder =
        std::filesystem::temp_directory_path() / ("cloudConversion" + std::to_string(getpid()));
    for (const bool binary : {true, false}) {
        WriteStyle style;
        style.binary = binary;
        writeCloud(folder, cloud(points, names), style);
        expectSame(materialPoints(readCloud(folder, "materialPoints"), names), points);
        std::filesystem::remove_all(folder);
    }
}

TEST(CloudConversion, stressTakesOpenFoamsPlaces)
{
    MaterialPoints points;
    points.resize(1, 0);
    for (int k = 0; k < 4; ++k) {
        points.stress[k][0] = k + 1; // rr zz tt rz
    }
    for (const NamedField& field : cloud(points, {}).fields) {
        if (field.name == "stress") {
            EXPECT_EQ(field.values, (std::vector<double>{1, 0, 4, 3, 0, 2})) << "xx xy xz yy yz zz";
            return;
        }
    }
    FAIL() << "no field 'stress'";
}

TEST(CloudConversion, brokenCloudsNameTheirFile)
{
    const Cloud good = cloud(randomPoints(10), names);
    EXPECT_EQ(failureOf(good), "");
    for (std::size_t k = 0; k < good.fields.size(); ++k) {
        const std::string file = "lagrangian/materialPoints/" + good.fields[k].name + ": ";
        Cloud broken = good;
        broken.fields.erase(broken.fields.begin() + static_cast<int>(k));
        EXPECT_EQ(failureOf(broken), file + "the field is missing");
        broken = good;
        broken.fields[k].values.pop_back();
        EXPECT_NE(failureOf(broken).find(file + "the field has "), std::string::npos) << failureOf(broken);
        broken = good;
        broken.fields[k].kind =
            good.fields[k].kind == FieldKind::scalar ? FieldKind::vector : FieldKind::scalar;
        EXPECT_NE(failureOf(broken).find("another kind"), std::string::npos) << failureOf(broken);
    }
    Cloud broken = good;
    broken.positions[3][1] = 1e-3;
    EXPECT_NE(failureOf(broken).find("off the plane y = 0"), std::string::npos);
}

TEST(MaterialPoints, reorderTakesEveryArrayAlong)
{
    const MaterialPoints before = randomPoints(500);
    std::vector<int> order(500), back(500);
    for (int i = 0; i < 500; ++i) {
        order[i] = (i * 7 + 3) % 500;
        back[order[i]] = i;
    }
    MaterialPoints points = before;
    points.reorder(order);
    for (int i = 0; i < 500; ++i) {
        EXPECT_EQ(points.id[i], before.id[order[i]]);
        EXPECT_EQ(points.state[1][i], before.state[1][order[i]]);
    }
    points.reorder(back);
    expectSame(points, before);
}

#include "output/Vtk.h"

#include "../case/TemporaryCase.h"
#include "case/FileIO.h"
#include "case/PolyMesh.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

using namespace caisson;
namespace fs = std::filesystem;

namespace {

std::vector<double> countingNumbers(std::size_t count)
{
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = 0.1 * static_cast<double>(i) - 1.0 / 3.0;
    }
    return values;
}

Cloud sampleCloud()
{
    Cloud cloud;
    cloud.positions = {{0.5, 0, 0.25}, {1.5, 0.01, 0.75}, {9, 0, -3}}; // the last one outside the mesh
    cloud.cells = {0, 4, -1};
    cloud.fields = {{"effectiveStress", FieldKind::symmTensor, countingNumbers(18)},
                    {"id", FieldKind::label, {7, 8, 9}},
                    {"porosity", FieldKind::scalar, countingNumbers(3)},
                    {"velocity", FieldKind::vector, countingNumbers(9)}};
    return cloud;
}

/// A VTK array must hold the field, symmTensor in VTK's order; `tolerance` relative.
void expectArray(vtkFieldData* data, const NamedField& field, double tolerance, const std::string& where)
{
    ASSERT_NE(data, nullptr) << where;
    vtkDataArray* const array = data->GetArray(field.name.c_str());
    ASSERT_NE(array, nullptr) << field.name << " is not in " << where;
    const int width = components(field.kind);
    ASSERT_EQ(array->GetNumberOfComponents(), width) << field.name;
    ASSERT_EQ(array->GetNumberOfTuples() * width, static_cast<vtkIdType>(field.values.size())) << field.name;
    constexpr std::array<int, 6> vtkOrder{0, 3, 5, 1, 4, 2};
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
        for (int k = 0; k < width; ++k) {
            const int from = field.kind == FieldKind::symmTensor ? vtkOrder[static_cast<std::size_t>(k)] : k;
            const double expected = field.values[static_cast<std::size_t>(i * width + from)];
            EXPECT_NEAR(array->GetComponent(i, k), expected, tolerance * std::abs(expected))
                << field.name << " " << i << " component " << k << " in " << where;
        }
    }
}

constexpr double floatTolerance = 1.2e-7; // vtkOpenFOAMReader and VtkPrecision::single keep 24 bits

vtkDataObject* block(vtkMultiBlockDataSet* blocks, const std::string& name)
{
    for (unsigned int i = 0; blocks != nullptr && i < blocks->GetNumberOfBlocks(); ++i) {
        if (blocks->HasMetaData(i) && name == blocks->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())) {
            return blocks->GetBlock(i);
        }
    }
    return nullptr;
}

} // namespace

TEST(Vtk, openFoamReaderShowsMeshFieldsAndCloud)
{
    for (const bool binary : {false, true}) {
        const std::string format = binary ? "binary" : "ascii";
        SCOPED_TRACE(format);
        const TemporaryCase testCase;
        fs::copy(fs::path(CAISSON_SOURCE_DIR) / "tests/case/data/wedge" / format, testCase.path(),
                 fs::copy_options::recursive);
        testCase.write(
            "system/controlDict",
            "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n"
            "startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 0.5; writeControl "
            "timeStep;\n"
            "writeInterval 1; writeFormat ascii; writePrecision 17; timeFormat general; timePrecision 6;\n");
        touchCaseFile(testCase.path());

        const PolyMesh mesh = readPolyMesh(testCase.path());
        const std::size_t points = mesh.points.size();
        const WriteStyle style{binary, 17, false};
        const Cloud cloud = sampleCloud();
        const std::vector<NamedField> pointFields{{"p", FieldKind::scalar, countingNumbers(points)},
                                                  {"U", FieldKind::vector, countingNumbers(3 * points)}};
        const std::vector<NamedField> cellFields{{"filled", FieldKind::scalar, countingNumbers(8)},
                                                 {"v", FieldKind::vector, countingNumbers(24)},
                                                 {"sigma", FieldKind::symmTensor, countingNumbers(48)}};
        std::vector<std::pair<std::string, std::string>> pointPatches;
        std::vector<std::pair<std::string, std::string>> cellPatches;
        for (const PolyPatch& patch : mesh.patches) {
            const bool special = patch.type == "wedge" || patch.type == "empty";
            pointPatches.emplace_back(patch.name, special ? "type " + patch.type + ";" : "type calculated;");
            cellPatches.emplace_back(patch.name, special ? "type " + patch.type + ";" : "type zeroGradient;");
        }
        std::vector<std::array<double, 3>> moved = mesh.points;
        for (auto& point : moved) {
            point[2] += 0.125;
        }
        for (const char* time : {"0", "0.5"}) {
            const fs::path folder = testCase.path() / time;
            writeCloud(folder, cloud, style);
            for (const NamedField& field : pointFields) {
                writeField(folder, field, true, "[0 0 0 0 0 0 0]", pointPatches, style);
            }
            for (const NamedField& field : cellFields) {
                writeField(folder, field, false, "[0 0 0 0 0 0 0]", cellPatches, style);
            }
        }
        writePoints(testCase.path() / "0.5", moved, style);

        vtkNew<vtkOpenFOAMReader> reader;
        reader->SetFileName((testCase.path() / "case.foam").c_str());
        reader->SkipZeroTimeOff();
        reader->UpdateInformation();
        ASSERT_EQ(reader->GetTimeValues()->GetNumberOfTuples(), 2);
        reader->EnableAllPatchArrays();
        reader->EnableAllCellArrays();
        reader->EnableAllPointArrays();
        reader->EnableAllLagrangianArrays();
        reader->CreateCellToPointOff();
        reader->UpdateTimeStep(0.5);

        vtkMultiBlockDataSet* const all = reader->GetOutput();
        auto* const grid = vtkUnstructuredGrid::SafeDownCast(block(all, "internalMesh"));
        ASSERT_NE(grid, nullptr) << "no internalMesh";
        ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(points));
        EXPECT_EQ(grid->GetNumberOfCells(), 8);
        for (std::size_t i = 0; i < points; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_NEAR(grid->GetPoint(static_cast<vtkIdType>(i))[k], moved[i][k], 1e-6)
                    << "moved point " << i;
            }
        }
        for (const NamedField& field : pointFields) {
            expectArray(grid->GetPointData(), field, floatTolerance, "internalMesh");
        }
        for (const NamedField& field : cellFields) {
            expectArray(grid->GetCellData(), field, floatTolerance, "internalMesh");
        }

        auto* const clouds = vtkMultiBlockDataSet::SafeDownCast(block(all, "lagrangian"));
        auto* const shown = vtkPolyData::SafeDownCast(block(clouds, "materialPoints"));
        ASSERT_NE(shown, nullptr) << "the cloud is not shown";
        ASSERT_EQ(shown->GetNumberOfPoints(), 3);
        EXPECT_EQ(shown->GetNumberOfVerts(), 3);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_NEAR(shown->GetPoint(static_cast<vtkIdType>(i))[k], cloud.positions[i][k], 1e-6);
            }
        }
        for (const NamedField& field : cloud.fields) {
            expectArray(shown->GetPointData(), field, floatTolerance, "the cloud");
        }
    }
}

TEST(Vtk, vtpHoldsPointsVerticesFieldsAndTime)
{
    for (const VtkPrecision precision : {VtkPrecision::single, VtkPrecision::twofold}) {
        const TemporaryCase testCase;
        const Cloud cloud = sampleCloud();
        writeVtp(testCase.path() / "VTK/soil_0.5.vtp", cloud, 0.5, precision);
        vtkNew<vtkXMLPolyDataReader> reader;
        reader->SetFileName((testCase.path() / "VTK/soil_0.5.vtp").c_str());
        reader->Update();
        vtkPolyData* const data = reader->GetOutput();
        ASSERT_EQ(data->GetNumberOfPoints(), 3);
        EXPECT_EQ(data->GetNumberOfVerts(), 3);
        EXPECT_EQ(data->GetCellType(2), VTK_VERTEX);
        const double tolerance = precision == VtkPrecision::single ? floatTolerance : 0;
        for (const NamedField& field : cloud.fields) {
            expectArray(data->GetPointData(), field, tolerance, "vtp");
        }
        expectArray(data->GetPointData(), {"cell", FieldKind::label, {0, 4, -1}}, 0, "vtp");
        expectArray(data->GetFieldData(), {"TimeValue", FieldKind::scalar, {0.5}}, 0, "vtp");
    }
}

TEST(Vtk, emptyCloudIsAValidFile)
{
    const TemporaryCase testCase;
    writeVtp(testCase.path() / "empty.vtp", Cloud{}, 0);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((testCase.path() / "empty.vtp").c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0U);
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_NE(reader->GetOutput()->GetPointData()->GetArray("cell"), nullptr);
}

TEST(Vtk, vtuHoldsCellsAndFields)
{
    for (const int corners : {3, 4}) {
        const TemporaryCase testCase;
        VtkGrid grid;
        grid.points = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
        grid.corners = corners;
        grid.cellPoints = corners == 3 ? std::vector<int>{0, 1, 2, 0, 2, 3} : std::vector<int>{0, 1, 2, 3};
        const std::size_t cells = grid.cellPoints.size() / static_cast<std::size_t>(corners);
        grid.pointFields = {{"U", FieldKind::vector, countingNumbers(12)}};
        grid.cellFields = {{"p", FieldKind::scalar, countingNumbers(cells)}};
        writeVtu(testCase.path() / "grid.vtu", grid, 2);
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        reader->SetFileName((testCase.path() / "grid.vtu").c_str());
        reader->Update();
        vtkUnstructuredGrid* const data = reader->GetOutput();
        ASSERT_EQ(data->GetNumberOfCells(), static_cast<vtkIdType>(cells));
        EXPECT_EQ(data->GetCellType(0), corners == 3 ? VTK_TRIANGLE : VTK_QUAD);
        EXPECT_EQ(data->GetCell(0)->GetPointId(2), 2);
        expectArray(data->GetPointData(), grid.pointFields[0], floatTolerance, "vtu");
        expectArray(data->GetCellData(), grid.cellFields[0], floatTolerance, "vtu");
        expectArray(data->GetFieldData(), {"TimeValue", FieldKind::scalar, {2}}, 0, "vtu");
    }
}

TEST(Vtk, seriesListsTheFilesOfThisRunInOrderOfTime)
{
    const TemporaryCase testCase;
    const fs::path folder = testCase.path() / "VTK";
    for (const char* time : {"0.5", "10", "2", "1e-05", "11"}) {
        writeVtp(vtkSeriesFile(folder, "soil", time, "vtp"), sampleCloud(), 0);
    }
    testCase.write("VTK/soil_x.vtp", "not one of the series");
    testCase.write("VTK/soil_water_3.vtp", "another cloud");
    writeVtkSeries(folder, "soil", "vtp", 10);
    EXPECT_EQ(testCase.read("VTK/soil.vtp.series"),
              "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n"
              "    { \"name\" : \"soil_1e-05.vtp\", \"time\" : 1e-05 },\n"
              "    { \"name\" : \"soil_0.5.vtp\", \"time\" : 0.5 },\n"
              "    { \"name\" : \"soil_2.vtp\", \"time\" : 2 },\n"
              "    { \"name\" : \"soil_10.vtp\", \"time\" : 10 }\n"
              "  ]\n}\n");
    const std::string pvd = testCase.read("VTK/soil.pvd");
    EXPECT_NE(pvd.find("<DataSet timestep=\"0.5\" part=\"0\" file=\"soil_0.5.vtp\"/>"), std::string::npos)
        << pvd;
    EXPECT_EQ(pvd.find("soil_11.vtp"), std::string::npos)
        << "a file after the present time is of an earlier run";
}

TEST(Vtk, failedWriteIsAnError)
{
    const TemporaryCase testCase;
    testCase.write("VTK", "a file where the folder should be");
    EXPECT_THROW(writeVtp(testCase.path() / "VTK/soil_1.vtp", sampleCloud(), 1), WriteError);
}

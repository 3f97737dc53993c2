#include "output/Vtk.h"

#include "case/FileIO.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace caisson {

namespace fs = std::filesystem;

namespace {

/// OpenFOAM's xx xy xz yy yz zz in VTK's order xx yy zz xy yz xz.
constexpr std::array<int, 6> symmTensorOrder{0, 3, 5, 1, 4, 2};

vtkSmartPointer<vtkDataArray> makeArray(FieldKind kind, VtkPrecision precision)
{
    if (kind == FieldKind::label) {
        return vtkSmartPointer<vtkIntArray>::New();
    }
    if (precision == VtkPrecision::single) {
        return vtkSmartPointer<vtkFloatArray>::New();
    }
    return vtkSmartPointer<vtkDoubleArray>::New();
}

template <class Array>
void fill(vtkDataArray& array, const NamedField& field)
{
    using Value = typename Array::ValueType;
    Value* const to = static_cast<Array&>(array).GetPointer(0);
    const auto width = static_cast<std::size_t>(components(field.kind));
    for (std::size_t i = 0; i < field.values.size(); ++i) {
        const std::size_t k = i % width;
        const std::size_t from = field.kind == FieldKind::symmTensor ? i - k + symmTensorOrder[k] : i;
        to[i] = static_cast<Value>(field.values[from]);
    }
}

void addField(vtkDataSetAttributes& attributes, const NamedField& field, vtkIdType size,
              VtkPrecision precision)
{
    const int width = components(field.kind);
    if (field.values.size() != static_cast<std::size_t>(size) * static_cast<std::size_t>(width)) {
        throw std::logic_error("field " + field.name + " has the wrong size for VTK");
    }
    const vtkSmartPointer<vtkDataArray> array = makeArray(field.kind, precision);
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(width);
    array->SetNumberOfTuples(size);
    if (field.kind == FieldKind::label) {
        fill<vtkIntArray>(*array, field);
    } else if (precision == VtkPrecision::single) {
        fill<vtkFloatArray>(*array, field);
    } else {
        fill<vtkDoubleArray>(*array, field);
    }
    attributes.AddArray(array);
}

vtkSmartPointer<vtkPoints> makePoints(const std::vector<std::array<double, 3>>& positions,
                                      VtkPrecision precision)
{
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataType(precision == VtkPrecision::single ? VTK_FLOAT : VTK_DOUBLE);
    points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
    for (std::size_t i = 0; i < positions.size(); ++i) {
        points->SetPoint(static_cast<vtkIdType>(i), positions[i].data());
    }
    return points;
}

/// Cells of `corners` points each, in the order of `cellPoint(0), cellPoint(1) ...`.
template <class CellPoint>
vtkSmartPointer<vtkCellArray> makeCells(vtkIdType cells, vtkIdType corners, CellPoint cellPoint)
{
    vtkNew<vtkIdTypeArray> offsets;
    vtkNew<vtkIdTypeArray> connectivity;
    offsets->SetNumberOfValues(cells + 1);
    connectivity->SetNumberOfValues(cells * corners);
    for (vtkIdType i = 0; i <= cells; ++i) {
        offsets->SetValue(i, i * corners);
    }
    for (vtkIdType i = 0; i < cells * corners; ++i) {
        connectivity->SetValue(i, cellPoint(i));
    }
    auto array = vtkSmartPointer<vtkCellArray>::New();
    array->SetData(offsets, connectivity);
    return array;
}

/// Lets VTK write into memory, so that a full disk is noticed by the one who writes files here.
template <class Writer>
void writeData(const fs::path& file, vtkDataSet& data, double time)
{
    vtkNew<vtkDoubleArray> timeValue;
    timeValue->SetName("TimeValue");
    timeValue->InsertNextValue(time);
    data.GetFieldData()->AddArray(timeValue);

    vtkNew<Writer> writer;
    writer->SetInputData(&data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0) {
        throw std::runtime_error("VTK could not make " + file.string());
    }
    writeFileAtomically(file, writer->GetOutputString());
}

} // namespace

void writeVtp(const fs::path& file, const Cloud& cloud, double time, VtkPrecision precision)
{
    const auto size = static_cast<vtkIdType>(cloud.positions.size());
    vtkNew<vtkPolyData> data;
    data->SetPoints(makePoints(cloud.positions, precision));
    data->SetVerts(makeCells(size, 1, [](vtkIdType i) { return i; }));
    addField(*data->GetPointData(), {"cell", FieldKind::label, {cloud.cells.begin(), cloud.cells.end()}},
             size, precision);
    for (const NamedField& field : cloud.fields) {
        addField(*data->GetPointData(), field, size, precision);
    }
    writeData<vtkXMLPolyDataWriter>(file, *data, time);
}

void writeVtu(const fs::path& file, const VtkGrid& grid, double time, VtkPrecision precision)
{
    const auto points = static_cast<vtkIdType>(grid.points.size());
    const auto cells = static_cast<vtkIdType>(grid.cellPoints.size()) / grid.corners;
    vtkNew<vtkUnstructuredGrid> data;
    data->SetPoints(makePoints(grid.points, precision));
    data->SetCells(grid.corners == 3 ? VTK_TRIANGLE : VTK_QUAD,
                   makeCells(cells, grid.corners,
                             [&](vtkIdType i) { return grid.cellPoints[static_cast<std::size_t>(i)]; }));
    for (const NamedField& field : grid.pointFields) {
        addField(*data->GetPointData(), field, points, precision);
    }
    for (const NamedField& field : grid.cellFields) {
        addField(*data->GetCellData(), field, cells, precision);
    }
    writeData<vtkXMLUnstructuredGridWriter>(file, *data, time);
}

fs::path vtkSeriesFile(const fs::path& folder, std::string_view name, std::string_view timeName,
                       std::string_view extension)
{
    std::string file(name);
    file.append("_").append(timeName).append(".").append(extension);
    return folder / file;
}

void writeVtkSeries(const fs::path& folder, std::string_view name, std::string_view extension, double time)
{
    struct Item
    {
        double time;
        std::string timeName;
    };
    std::vector<Item> items;
    const std::string prefix = std::string(name) + "_";
    const std::string suffix = "." + std::string(extension);
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string file = entry.path().filename().string();
        if (!file.starts_with(prefix) || !file.ends_with(suffix) ||
            file.size() <= prefix.size() + suffix.size()) {
            continue;
        }
        Item item{0, file.substr(prefix.size(), file.size() - prefix.size() - suffix.size())};
        const char* const end = item.timeName.data() + item.timeName.size();
        const auto [stopped, error] = std::from_chars(item.timeName.data(), end, item.time);
        // Names are rounded, by less than this.
        if (error == std::errc{} && stopped == end && item.time <= time + 1e-5 * std::abs(time)) {
            items.push_back(std::move(item));
        }
    }
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.time < b.time; });

    std::string series = "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n";
    std::string pvd = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                      "byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const Item& item : items) {
        std::string file = prefix;
        file.append(item.timeName).append(suffix);
        series.append("    { \"name\" : \"").append(file).append("\", \"time\" : ").append(item.timeName);
        series.append(&item == &items.back() ? " }\n" : " },\n");
        pvd.append("    <DataSet timestep=\"").append(item.timeName).append("\" part=\"0\" file=\"");
        pvd.append(file).append("\"/>\n");
    }
    writeFileAtomically(folder / (std::string(name) + suffix + ".series"), series + "  ]\n}\n");
    writeFileAtomically(folder / (std::string(name) + ".pvd"), pvd + "  </Collection>\n</VTKFile>\n");
}

void touchCaseFile(const fs::path& caseDirectory)
{
    if (!fs::exists(caseDirectory / "case.foam")) {
        writeFileAtomically(caseDirectory / "case.foam", "");
    }
}

} // namespace caisson

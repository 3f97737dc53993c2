"""Reads a case and its points as ParaView does, and checks what is in them."""
import sys

from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def blocks(data):
    """Names and leaves of a multi-block data set."""
    for i in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(i)
        name = data.GetMetaData(i).Get(data.NAME()) if data.HasMetaData(i) else ""
        if block is None:
            continue
        if hasattr(block, "GetNumberOfBlocks"):
            yield from blocks(block)
        else:
            yield name, block


def names(attributes):
    return {attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())}


def check(claim, good):
    if not good:
        sys.exit("FAILED: " + claim)


reader = vtkOpenFOAMReader()
reader.SetFileName(sys.argv[1])
reader.UpdateInformation()
reader.SetTimeValue(0.4)
reader.EnableAllCellArrays()
reader.EnableAllPointArrays()
reader.EnableAllLagrangianArrays()
reader.EnableAllPatchArrays()
reader.Update()
leaves = dict(blocks(reader.GetOutput()))
mesh = leaves["internalMesh"]
check("the mesh has 1020 cells, got %d" % mesh.GetNumberOfCells(), mesh.GetNumberOfCells() == 1020)
check("U at the points, got %s" % names(mesh.GetPointData()), "U" in names(mesh.GetPointData()))
check("filled in the cells, got %s" % names(mesh.GetCellData()), "filled" in names(mesh.GetCellData()))
cloud = leaves["materialPoints"]
check("5440 material points, got %d" % cloud.GetNumberOfPoints(), cloud.GetNumberOfPoints() == 5440)
wanted = {"velocity", "stress", "mass", "volume", "id", "material"}
check("fields %s of the cloud, got %s" % (wanted, names(cloud.GetPointData())), wanted <= names(cloud.GetPointData()))

points = vtkXMLPolyDataReader()
points.SetFileName(sys.argv[2])
points.Update()
data = points.GetOutput()
check("5440 points in the vtp, got %d" % data.GetNumberOfPoints(), data.GetNumberOfPoints() == 5440)
lowest = data.GetPointData().GetArray("stress").GetRange(1)
check("stresses are compressive below, got %s" % str(lowest), lowest[0] < 0)

#pragma once

// All of ExplicitStep, for the files that compile it, one per shape of the cells and number of phases.
#include "timeStepping/CellKernels.h"
#include "timeStepping/NodeKernels.h"
#include "timeStepping/NodesToPoints.h"
#include "timeStepping/PointsToNodes.h"
#include "timeStepping/ProjectionKernels.h"
#include "timeStepping/RectangleKernels.h"
#include "timeStepping/SortKernels.h"
#include "timeStepping/StableStepKernels.h"

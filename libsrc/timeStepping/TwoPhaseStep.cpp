#include "timeStepping/CellKernels.h"
#include "timeStepping/NodeKernels.h"
#include "timeStepping/NodesToPoints.h"
#include "timeStepping/PointsToNodes.h"
#include "timeStepping/ProjectionKernels.h"
#include "timeStepping/RectangleKernels.h"
#include "timeStepping/SortKernels.h"
#include "timeStepping/StableStepKernels.h"

namespace caisson {

template class ExplicitStep<shapes::Rectangle<true>, 2>;
template class ExplicitStep<shapes::Rectangle<false>, 2>;
template class ExplicitStep<shapes::Quadrilateral<true>, 2>;
template class ExplicitStep<shapes::Quadrilateral<false>, 2>;
template class ExplicitStep<shapes::Triangle<true>, 2>;
template class ExplicitStep<shapes::Triangle<false>, 2>;

} // namespace caisson

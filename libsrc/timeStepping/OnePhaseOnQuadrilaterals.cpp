#include "timeStepping/StepKernels.h"

namespace caisson {

template class ExplicitStep<shapes::Quadrilateral<true>, 1>;
template class ExplicitStep<shapes::Quadrilateral<false>, 1>;

} // namespace caisson

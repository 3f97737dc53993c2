#include "timeStepping/StepKernels.h"

namespace caisson {

template class ExplicitStep<shapes::Quadrilateral<true>, 2>;
template class ExplicitStep<shapes::Quadrilateral<false>, 2>;

} // namespace caisson

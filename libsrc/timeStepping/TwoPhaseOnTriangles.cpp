#include "timeStepping/StepKernels.h"

namespace caisson {

template class ExplicitStep<shapes::Triangle<true>, 2>;
template class ExplicitStep<shapes::Triangle<false>, 2>;

} // namespace caisson

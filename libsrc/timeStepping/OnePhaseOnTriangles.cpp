#include "timeStepping/StepKernels.h"

namespace caisson {

template class ExplicitStep<shapes::Triangle<true>, 1>;
template class ExplicitStep<shapes::Triangle<false>, 1>;

} // namespace caisson

#include "timeStepping/StepKernels.h"

namespace caisson {

template class ExplicitStep<shapes::Rectangle<true>, 1>;
template class ExplicitStep<shapes::Rectangle<false>, 1>;

} // namespace caisson

#include "timeStepping/StepKernels.h"

namespace caisson {

template class ExplicitStep<shapes::Rectangle<true>, 2>;
template class ExplicitStep<shapes::Rectangle<false>, 2>;

} // namespace caisson

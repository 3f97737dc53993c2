#include "timeStepping/PressureSolver.h"

namespace caisson {

void PressureSolver::factorise(int n, const std::vector<Eigen::Triplet<double>>& entries)
{
    matrix_.resize(n, n);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(matrix_);
    size_ = factor_.info() == Eigen::Success ? n : 0;
}

int PressureSolver::solve(const std::function<void(const Vector&, Vector&)>& multiply, const Vector& b,
                          Vector& x, double tolerance, int limit)
{
    const double target = tolerance * b.norm();
    multiply(x, product_);
    residual_ = b - product_;
    double last = 0;
    for (int i = 0; i <= limit; ++i) {
        if (residual_.norm() <= target) {
            return i;
        }
        preconditioned_ = factor_.solve(residual_);
        const double now = residual_.dot(preconditioned_);
        if (i == 0) {
            direction_ = preconditioned_;
        } else {
            direction_ = preconditioned_ + now / last * direction_;
        }
        last = now;
        multiply(direction_, product_);
        const double step = now / direction_.dot(product_);
        x += step * direction_;
        residual_ -= step * product_;
    }
    return -1;
}

} // namespace caisson

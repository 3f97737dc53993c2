#pragma once

#include <Eigen/SparseCholesky>

#include <functional>
#include <vector>

namespace caisson {

/// Conjugate gradients for the pressure increments of a projection step, preconditioned with a factorised
/// matrix of some steps ago, which is nearly that of this one.
class PressureSolver
{
public:
    using Vector = Eigen::VectorXd;

    /// Factorises a symmetric positive definite matrix of n rows, given as entries that add up.
    void factorise(int n, const std::vector<Eigen::Triplet<double>>& entries);
    [[nodiscard]] bool factorised() const { return factor_.info() == Eigen::Success && size_ > 0; }
    void forget() { size_ = 0; }

    /// Solves A x = b to a residual of `tolerance` times that of x = 0, from x as it is.
    /// @returns the iterations that it took, or -1 where it has not come there in `limit` of them
    int solve(const std::function<void(const Vector&, Vector&)>& multiply, const Vector& b, Vector& x,
              double tolerance, int limit);

private:
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
    Eigen::SparseMatrix<double> matrix_;
    int size_ = 0;
    Vector residual_, direction_, preconditioned_, product_;
};

} // namespace caisson

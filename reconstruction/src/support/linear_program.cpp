#include "support/linear_program.hpp"

#include <coin/Clp_C_Interface.h>

#include <memory>

namespace vantage::reconstruction::detail {

int LinearProgram::add_row(double lowest, double highest) {
  lowest_.push_back(lowest);
  highest_.push_back(highest);
  return int(lowest_.size()) - 1;
}

int LinearProgram::add_unknown(double cost, const Entries& entries) {
  costs_.push_back(cost);
  for (const auto& [row, value] : entries) {
    if (value == 0) continue;
    rows_.push_back(row);
    values_.push_back(value);
  }
  starts_.push_back(int(rows_.size()));
  return int(costs_.size()) - 1;
}

std::vector<double> LinearProgram::solve() const {
  if (costs_.empty()) return {};
  const std::unique_ptr<Clp_Simplex, decltype(&Clp_deleteModel)> model(Clp_newModel(),
                                                                       &Clp_deleteModel);
  Clp_setLogLevel(model.get(), 0);
  const std::vector<double> zeros(costs_.size(), 0), unbounded(costs_.size(), kUnbounded);
  Clp_loadProblem(model.get(), int(costs_.size()), int(lowest_.size()), starts_.data(),
                  rows_.data(), values_.data(), zeros.data(), unbounded.data(), costs_.data(),
                  lowest_.data(), highest_.data());
  // No cost is negative, so that the dual method starts from a feasible basis.
  Clp_dual(model.get(), 0);
  if (Clp_status(model.get()) != 0) return {};
  const double* solution = Clp_primalColumnSolution(model.get());
  return {solution, solution + costs_.size()};
}

}  // namespace vantage::reconstruction::detail

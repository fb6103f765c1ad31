// The work that the compiler spends on expressions that the instance decides.
#pragma once

namespace rddlc::ir {

// In operations (Properties::cost). One pass has one budget, so no pass takes longer than a few
// seconds.
class EvaluationBudget {
  public:
    // Whether a single expression of that cost may be evaluated at all.
    static constexpr bool allows(double cost) { return cost <= most_for_one; }

    // Pays for an expression. False, and nothing is paid, if it costs too much.
    bool pay(double cost) {
        if (!allows(cost) || cost > left_) return false;
        left_ -= cost;
        return true;
    }

  private:
    static constexpr double most_for_one = 1e7, most_in_all = 1e8;

    double left_ = most_in_all;
};

}  // namespace rddlc::ir

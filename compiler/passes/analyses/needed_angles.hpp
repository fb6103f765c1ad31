// The sines and cosines that every step needs, and whose angles are known before it.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <vector>

namespace rddlc::passes {

class NeededAngles {
  public:
    // Both must outlive this.
    NeededAngles(const ir::Program& program, ir::Builder& builder)
        : program_(program), builder_(builder) {}

    // The functions, in the order of their first use. They neither draw nor fault, and differ
    // between environments.
    std::vector<ir::NodeId> of(const ir::Block& block) const;
    std::vector<ir::NodeId> of(const ir::Computation& computation) const;

  private:
    class Search;

    const ir::Program& program_;
    ir::Builder& builder_;
};

}  // namespace rddlc::passes

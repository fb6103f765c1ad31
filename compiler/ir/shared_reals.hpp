// Numbers that copies share until one of the copies changes them: passes copy programs, and a
// fluent may have millions of bounds.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <vector>

namespace rddlc::ir {

class SharedReals {
  public:
    SharedReals() = default;
    SharedReals(std::initializer_list<double> values)
        : values_(std::make_shared<std::vector<double>>(values)) {}
    SharedReals(const SharedReals&) =
        default;  // also where it is moved from, so that it has numbers
    SharedReals& operator=(const SharedReals&) = default;
    ~SharedReals() = default;

    const std::vector<double>& operator*() const { return *values_; }
    const std::vector<double>* operator->() const { return values_.get(); }

    void assign(std::size_t count, double value) {
        values_ = std::make_shared<std::vector<double>>(count, value);
    }
    std::vector<double>& to_change() {
        if (values_.use_count() > 1) values_ = std::make_shared<std::vector<double>>(*values_);
        return *values_;
    }

  private:
    std::shared_ptr<std::vector<double>> values_ = std::make_shared<std::vector<double>>();
};

}  // namespace rddlc::ir

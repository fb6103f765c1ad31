#include "ir/outcomes.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::ir {

namespace {

// The first one with a positive probability from `begin` on; the size if there is none.
std::size_t next_possible(const std::vector<double>& probabilities, std::size_t begin) {
    const auto found = std::find_if(probabilities.begin() + static_cast<std::ptrdiff_t>(begin),
                                    probabilities.end(), [](double p) { return p > 0; });
    return static_cast<std::size_t>(found - probabilities.begin());
}

}  // namespace

std::int64_t Outcomes::choose(rddl::Place place, std::vector<double> probabilities) {
    for (std::size_t i = 0; i < made_; ++i)
        if (draws_[i].place.series == place.series && draws_[i].place.index == place.index)
            return static_cast<std::int64_t>(draws_[i].chosen);
    if (made_ == draws_.size()) {
        const std::size_t first = next_possible(probabilities, 0);
        draws_.push_back({place, std::move(probabilities), first});
    }
    return static_cast<std::int64_t>(draws_[made_++].chosen);
}

double Outcomes::probability() const {
    double product = 1;
    for (std::size_t i = 0; i < made_; ++i) product *= draws_[i].probabilities[draws_[i].chosen];
    return product;
}

bool Outcomes::next() {
    made_ = 0;
    while (!draws_.empty()) {
        Draw& last = draws_.back();
        last.chosen = next_possible(last.probabilities, last.chosen + 1);
        if (last.chosen < last.probabilities.size()) return true;
        draws_.pop_back();
    }
    return false;
}

}  // namespace rddlc::ir

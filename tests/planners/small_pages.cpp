// Large arrays also compile where the system has pages of one size alone, as macOS has.
#include <sys/mman.h>
#undef MADV_HUGEPAGE
#include "planners/uct/large_pages.hpp"

namespace rddlc::planners {
namespace {

struct Item {
    int number = 0;
};

}  // namespace

std::size_t size_of_large_array();
std::size_t size_of_large_array() {
    return LargeVector<Item>(LargePages<Item>::page).size();
}

}  // namespace rddlc::planners

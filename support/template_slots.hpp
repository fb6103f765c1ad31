// Filling the skeletons of templates/: named slots `${name}` and nothing else.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rddlc {

using SlotValues = std::map<std::string, std::string, std::less<>>;

// Replaces every slot by its value. A slot alone on its line keeps that line's indentation for
// every line of its value; an empty value then removes the line.
// Throws std::logic_error (an internal error: skeletons and values are both ours) when the
// skeleton names a slot without a value, a value has no slot, or a "${" is not closed.
std::string fill_slots(std::string_view skeleton, const SlotValues& values);

}  // namespace rddlc

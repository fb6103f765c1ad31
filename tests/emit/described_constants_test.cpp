// Constants of the description that the text has nowhere else.
#include "emitted.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rddlc {
namespace {

// A belt whose items move by a place, and NUMBER says where the next one is put.
std::string belt(int count) {
    std::string objects, values;
    for (int i = 0; i < count; ++i) {
        objects += (i > 0 ? ", s" : "s") + std::to_string(i);
        values += "NUMBER(s" + std::to_string(i) + ") = " + std::to_string(i + 1) + "; ";
        if (i > 0) values += "AFTER(s" + std::to_string(i - 1) + ", s" + std::to_string(i) + "); ";
    }
    return "domain d { types { slot : object; }; pvariables {\n"
           "AFTER(slot, slot) : { non-fluent, bool, default = false };\n"
           "NUMBER(slot) : { non-fluent, int, default = 0 };\n"
           "item(slot) : { state-fluent, real, default = 0.0 };\n"
           "due : { state-fluent, int, default = 3 };\n"
           "put : { action-fluent, real, default = 0.5 };\n"
           "}; cpfs { due' = due;\n"
           "item'(?s) = (NUMBER(?s) == due) * 0.5 * put + (sum_{?n : slot} [AFTER(?s, ?n) * "
           "item(?n)]);\n"
           "}; reward = put; }\n"
           "non-fluents n { domain = d; objects { slot : {" +
           objects + "}; }; non-fluents { " + values +
           "}; }\n"
           "instance i { domain = d; non-fluents = n; horizon = 5; discount = 1.0; }\n";
}

TEST(DescribedConstants, IncludeThoseThatNoStepReads) {
    PassOptions passes;
    passes.fast_math = true;
    const std::string text = emitted(belt(12), {}, passes);
    EXPECT_NE(text.find("rddl::shift<"), std::string::npos);
    EXPECT_NE(text.find("NUMBER_values_ = {"), std::string::npos);
    EXPECT_NE(text.find("rddl::constants(1, NUMBER_values_)"), std::string::npos);
}

}  // namespace
}  // namespace rddlc

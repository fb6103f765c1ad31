#include "passes/lanes/keep_unchosen.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

// Objects that rovers use tools on.
ir::Program grounded_with(const std::string& cpf) {
    return grounded_with_many({.pvariables =
                                   "seen(obj) : { state-fluent, bool, default = false };\n"
                                   "lost(obj) : { state-fluent, bool, default = false };\n"
                                   "use(obj, obj) : { action-fluent, bool, default = false };\n"
                                   "help(obj) : { action-fluent, bool, default = false };",
                               .cpfs = "seen'(?o) = " + cpf + "; lost'(?o) = lost(?o);"});
}

constexpr const char* seen =
    "seen(?o) | exists_{?p : obj, ?q : obj} [use(?p, ?o) ^ (lost(?q) | help(?q))]";

TEST(KeepUnchosen, SaysWhatIsKept) {
    passes::Report report;
    const ir::Program program = valid(passes::keep_unchosen(grounded_with(seen), report));
    EXPECT_NE(step_text(program).find("state.seen unless action.use\n"), std::string::npos)
        << step_text(program);
    EXPECT_EQ(report["definitions that keep the state where nothing is chosen"], 1);
    EXPECT_EQ(ir::print(passes::keep_unchosen(program, report)), ir::print(program));
}

TEST(KeepUnchosen, LeavesOthers) {
    for (const char* cpf :
         {"seen(?o) | use(?o, ?o)",
          "seen(?o) ^ exists_{?p : obj, ?q : obj} [use(?p, ?o) ^ lost(?q) ^ help(?q)]",
          "seen(?o) | exists_{?p : obj, ?q : obj} [use(?p, ?o) | lost(?q) ^ help(?q) | lost(?p)]",
          "exists_{?p : obj, ?q : obj} [seen(?q) ^ lost(?p)]",
          "seen(?o) | exists_{?p : obj, ?q : obj} [use(?p, Discrete_{?r : obj} [lost(?r)]) ^ "
          "lost(?q)]"}) {
        const ir::Program program = grounded_with(cpf);
        passes::Report report;
        EXPECT_EQ(ir::print(passes::keep_unchosen(program, report)), ir::print(program));
    }
}

}  // namespace
}  // namespace rddlc

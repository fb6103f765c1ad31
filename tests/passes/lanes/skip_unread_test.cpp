#include "passes/lanes/skip_unread.hpp"

#include "passes/lanes/keep_unchosen.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

// Objects that rovers use tools on, if they are in reach.
ir::Program kept_with(
    const std::string& near, const std::string& other = "lost(?o)",
    const std::string& actions = "help : { action-fluent, bool, default = false };") {
    passes::Report report;
    return passes::keep_unchosen(
        grounded_with_many(
            {.pvariables = "seen(obj) : { state-fluent, bool, default = false };\n"
                           "lost(obj) : { state-fluent, bool, default = false };\n"
                           "near(obj) : { interm-fluent, bool, level = 1 };\n"
                           "use(obj, obj) : { action-fluent, bool, default = false };\n" +
                           actions,
             .cpfs = "near(?o) = " + near + "; lost'(?o) = " + other +
                     "; seen'(?o) = seen(?o) | exists_{?p : obj, ?q : obj} "
                     "[use(?p, ?o) ^ (lost(?q) | near(?q))];"}),
        report);
}

TEST(SkipUnread, MovesWhatSkippedDefinitionsReadToThem) {
    passes::Report report;
    const ir::Program program = valid(passes::skip_unread(kept_with("~lost(?o)"), report));
    const std::string text = step_text(program);
    const std::size_t unread = text.find("unread unless action.use\n");
    ASSERT_NE(unread, std::string::npos) << text;
    EXPECT_LT(text.find("next.lost"), unread) << text;
    EXPECT_LT(unread, text.find("scratch.near")) << text;
    EXPECT_LT(text.find("scratch.near"), text.find("state.seen unless action.use\n")) << text;
    EXPECT_EQ(report["definitions that nothing reads where nothing is chosen"], 1);
    EXPECT_EQ(ir::print(passes::skip_unread(program, report)), ir::print(program));
}

TEST(SkipUnread, LeavesWhatOthersReadMayFaultOrIsMostlyRead) {
    for (const ir::Program& program :
         {kept_with("~lost(?o)", "near(?o)"), kept_with("~lost(?o)", "lost(?o)", ""),
          kept_with("Bernoulli(1.5 * lost(?o))")}) {
        passes::Report report;
        EXPECT_EQ(ir::print(passes::skip_unread(program, report)), ir::print(program));
    }
}

}  // namespace
}  // namespace rddlc

// The content of the model: types, values, order of evaluation, and its printed form.
#include "checking.hpp"
#include "model/print.hpp"

#include <gtest/gtest.h>

namespace rddlc::testing {
namespace {

using model::Value;

std::vector<std::string> evaluation_order(const model::Model& model) {
    std::vector<std::string> names;
    for (const model::Cpf& cpf : model.cpfs) {
        const model::Fluent& fluent = model.fluents[cpf.fluent];
        names.push_back(fluent.name + (fluent.role == Role::State ? "'" : ""));
    }
    return names;
}

const model::Fluent& fluent_named(const model::Model& model, std::string_view name) {
    return *std::ranges::find(model.fluents, name, &model::Fluent::name);
}

TEST(Order, ByLevelThenByName) {
    const Checked checked = check_text(R"(
        domain order {
            pvariables {
                a : { state-fluent, real, default = 0.0 };
                b : { state-fluent, real, default = 0.0 };
                B : { state-fluent, real, default = 0.0 };
                z : { interm-fluent, real };
                m : { interm-fluent, real };
                k : { interm-fluent, real };
            };
            cpfs {
                b' = z + k;
                z = m;
                k = m + a;
                m = b;
                a' = a;
                B' = B;
            };
            reward = a;
        }
        non-fluents none { domain = order; }
        instance i { domain = order; non-fluents = none; horizon = 1; discount = 1.0; }
    )");
    ASSERT_TRUE(checked.model) << checked.rendered();
    const std::vector<std::string> expected = {"B'", "a'", "m", "k", "z", "b'"};
    EXPECT_EQ(evaluation_order(*checked.model), expected);
}

constexpr std::string_view grid = R"(
    domain grid {
        types { cell : object; colour : {@red, @green}; };
        pvariables {
            WIDTH(cell, colour) : { non-fluent, real, default = 1.0 };
            START : { non-fluent, cell };
            PAINT(cell) : { non-fluent, colour, default = @green };
            seen(cell) : { state-fluent, bool, default = false };
            count : { state-fluent, int, default = true };
            go(cell) : { action-fluent, bool, default = false };
        };
        cpfs {
            seen'(?c) = seen(?c) | go(?c) | ?c == START;
            count' = count + (sum_{?c : cell} go(?c));
        };
        reward = sum_{?c : cell} WIDTH(?c, PAINT(?c));
        termination { forall_{?c : cell} seen(?c); };
    }
    instance small {
        domain = grid;
        objects { cell : {c1, c2}; };
        non-fluents { WIDTH(c1, @green) = 2; WIDTH(c2, red) = 3.5; START = c2; PAINT(c2) = red; };
        init-state { seen(c2); };
        max-nondef-actions = 1;
        horizon = 40;
        discount = 0.9;
    }
)";

TEST(Values, AreRowMajorAndOfTheRange) {
    const Checked checked = check_text(std::string(grid));
    ASSERT_TRUE(checked.model) << checked.rendered();
    const model::Model& model = *checked.model;
    const auto values = [&](std::string_view name) {
        return fluent_named(model, name).values;
    };
    EXPECT_EQ(values("WIDTH"), (std::vector<Value>{1.0, 2.0, 3.5, 1.0}));
    EXPECT_EQ(values("START"), (std::vector<Value>{std::int64_t{1}}));
    EXPECT_EQ(values("PAINT"), (std::vector<Value>{std::int64_t{1}, std::int64_t{0}}));
    EXPECT_EQ(values("seen"), (std::vector<Value>{false, true}));
    EXPECT_EQ(values("count"), (std::vector<Value>{std::int64_t{1}}));
    EXPECT_EQ(values("go"), (std::vector<Value>{false, false}));
    EXPECT_EQ(model.horizon, 40);
    EXPECT_EQ(model.discount, 0.9);
    EXPECT_EQ(model.max_nondef_actions, 1);
}

TEST(Print, ShowsEverything) {
    const Checked checked = check_text(std::string(grid));
    ASSERT_TRUE(checked.model) << checked.rendered();
    EXPECT_EQ(model::print(*checked.model), R"(domain grid
instance small
horizon 40
discount 0.9
max-nondef-actions 1

types
    cell: {c1, c2}
    colour: enum {@red, @green}

fluents
    non-fluent WIDTH(cell, colour): real[2][2] default 1.0 = [1.0, 2.0, 3.5, 1.0]
    non-fluent START: cell = c2
    non-fluent PAINT(cell): colour[2] default @green = [@green, @red]
    state-fluent seen(cell): bool[2] default false = [false, true]
    state-fluent count: int default 1 = 1
    action-fluent go(cell): bool[2] default false = false

cpfs
    count': int =
        (count + sum_{?c: cell} [int(go(?c))])
    seen'(?c: cell): bool =
        ((seen(?c) | go(?c)) | (?c == START))

reward
    sum_{?c: cell} [WIDTH(?c, PAINT(?c))]

termination
    forall_{?c: cell} [seen(?c)]
)");
}

TEST(Blocks, MayStandInAnyOrder) {
    const Checked checked = check_text(R"(
        instance i { horizon = 1; discount = 1.0; domain = d; non-fluents = none; }
        non-fluents none { domain = d; }
        domain d {
            reward = p;
            cpfs { p' = ~p; };
            pvariables { p : { state-fluent, bool, default = false }; };
        }
    )");
    EXPECT_TRUE(checked.model) << checked.rendered();
}

TEST(Blocks, AllThatAreMissingAreReported) {
    const Checked checked = check_text("policy p { cpfs { a = 1; }; }");
    EXPECT_EQ(checked.codes(), "E0204 E0204") << checked.rendered();
}

TEST(Blocks, AnInstanceWithNonFluentsListsItsObjectsToo) {
    std::string text(grid);
    text.replace(text.find("objects { cell : {c1, c2}; };"), 29, "");
    const Checked checked = check_text(text);
    EXPECT_EQ(checked.codes().substr(0, 5), "E0212") << checked.rendered();
    EXPECT_NE(checked.codes().find("E0205"), std::string::npos) << checked.rendered();
}

TEST(Values, TablesThatAreTooLargeAreRefused) {
    std::string objects = "o0";
    for (int i = 1; i < 1000; ++i) objects += ", o" + std::to_string(i);
    const Checked checked = check_text(R"(
        domain d {
            types { t : object; };
            pvariables {
                FAR(t, t, t, t, t, t, t, t, t, t) : { non-fluent, real, default = 0.0 };
                p : { state-fluent, bool, default = false };
            };
            cpfs { p' = exists_{?x : t} FAR(?x, ?x, ?x, ?x, ?x, ?x, ?x, ?x, ?x, ?x) > 0; };
            reward = p;
        }
        non-fluents n { domain = d; objects { t : {)" +
                                       objects + R"(}; }; }
        instance i { domain = d; non-fluents = n; horizon = 1; discount = 1.0; }
    )");
    EXPECT_EQ(checked.codes(), "E0230") << checked.rendered().substr(0, 1000);
}

}  // namespace
}  // namespace rddlc::testing

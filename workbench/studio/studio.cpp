#include "studio/studio.hpp"

#include "support/failure.hpp"
#include "support/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

namespace rddlc::studio {

namespace {

constexpr std::size_t most_tabs = 64;
constexpr std::size_t longest_id = 64;
constexpr std::chrono::milliseconds longest_wait_for_jobs{2000};

Reply refusal(int status, const std::string& why, const std::string& hint = {}) {
    Json body{{"error", why}};
    if (!hint.empty()) body["hint"] = hint;
    return {status, "application/json", json_line(body)};
}

}  // namespace

Studio::Studio(OpenedProblem problem, StudioOptions options)
    : context_(std::make_shared<const TabContext>(
          TabContext{std::move(problem), std::move(options.load), std::make_shared<Workers>()})) {}

Studio::~Studio() {
    stop();
}

bool Studio::stop() {
    context_->workers->stop_all();
    return jobs_end(longest_wait_for_jobs);
}

bool Studio::jobs_end(std::chrono::milliseconds longest) {
    return context_->workers->wait(longest);
}

// The tab that was used longest ago makes room for a new one. It ends outside the lock, once its
// requests have their answers.
std::shared_ptr<Tab> Studio::tab_of(const std::string& id) {
    if (id.empty() || id.size() > longest_id) throw Failure("this is not the name of a tab");
    std::shared_ptr<Tab> dropped;
    const std::scoped_lock lock(mutex_);
    if (!tabs_.contains(id) && tabs_.size() >= most_tabs) {
        const auto oldest =
            std::ranges::min_element(tabs_, {}, [](const auto& each) { return each.second.used; });
        dropped = std::move(oldest->second.tab);
        tabs_.erase(oldest);
    }
    Entry& entry = tabs_[id];
    if (!entry.tab) entry.tab = std::make_shared<Tab>(context_);
    entry.used = ++uses_;
    return entry.tab;
}

Reply Studio::answer(const std::string& name, std::string_view body) {
    try {
        const nlohmann::json request = parse_json(body);
        if (!request.is_object()) throw Failure("the request is not a JSON object");
        return tab_of(request.at("tab").get<std::string>())->answer(name, request);
    } catch (const Failure& failure) {
        return refusal(422, failure.what(), failure.hint);
    } catch (const RefusedJson& error) {
        return refusal(400, error.what());
    } catch (const nlohmann::json::exception& error) {
        return refusal(400, error.what());
    } catch (const Diagnosed&) {
        return refusal(422, diagnostics_elsewhere);
    } catch (const std::bad_alloc&) {
        return refusal(503, "not enough memory");
    } catch (const std::exception& error) {
        return refusal(500, error.what());
    }
}

}  // namespace rddlc::studio

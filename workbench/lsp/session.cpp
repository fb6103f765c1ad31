#include "lsp/session.hpp"

#include "driver/version.hpp"
#include "lsp/capabilities.hpp"

#include <fmt/format.h>

#include <exception>

namespace rddlc::lsp {

namespace {

Json response(const Json& id, Json result) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}

Json failure(const Json& id, int code, const std::string& message) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}};
}

Json notification(const char* method, Json params) {
    return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}};
}

bool is_id(const Json& id) {
    return id.is_string() || id.is_number_integer();
}

Json capabilities() {
    constexpr int incremental = 2;
    return {{"positionEncoding", "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", incremental}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"referencesProvider", true},
            {"documentHighlightProvider", true},
            {"completionProvider", {{"triggerCharacters", {"?", "@", "("}}}},
            {"renameProvider", {{"prepareProvider", true}}},
            {"documentSymbolProvider", true},
            {"documentFormattingProvider", true},
            {"inlayHintProvider", true},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix", "source.fixAll.rddl"}}}}};
}

// A method that the server does not have.
struct UnknownMethod {};

}  // namespace

Json Session::cancelled(const Json& id) {
    return failure(id, request_cancelled, "cancelled");
}

std::vector<Json> Session::handle_malformed(const std::string& reason) const {
    return {failure(nullptr, parse_error, reason)};
}

std::vector<Json> Session::handle(const Json& message) {
    const bool is_message =
        message.is_object() && message.contains("method") && message["method"].is_string();
    const Json id = is_message && message.contains("id") ? message["id"] : Json();
    const bool is_request = is_message && message.contains("id");
    // Responses are answers to requests of ours, and there are none.
    if (message.is_object() && !message.contains("method") && message.contains("id")) return {};
    if (!is_message) return {failure(nullptr, invalid_request, "this is no message")};
    if (is_request && !is_id(id)) return {failure(nullptr, invalid_request, "the id is no id")};
    const std::string method = message["method"];
    const Json params = message.value("params", Json::object());
    try {
        if (is_request) return {response(id, answer(method, params))};
        notice(method, params);
        return {};
    } catch (const UnknownMethod&) {
        return {failure(id, method_not_found, fmt::format("there is no method '{}'", method))};
    } catch (const Refusal& refusal) {
        const int code = phase_ == Phase::Start      ? not_initialized
                         : phase_ == Phase::ShutDown ? invalid_request
                                                     : request_failed;
        return {failure(id, code, refusal.what())};
    } catch (const Json::exception& error) {
        if (!is_request) return {};
        return {failure(id, invalid_params, error.what())};
    } catch (const std::exception& error) {
        if (!is_request) return {};
        return {failure(id, internal_fault, error.what())};
    }
}

// -------------------------------------------------------------------------------- the session

Json Session::initialize(const Json& params) {
    if (phase_ != Phase::Start) throw Refusal("the server is initialized already");
    const Json options = params.value("initializationOptions", Json());
    if (options.is_object() && options.contains("standard"))
        standard_ = options["standard"] == "rddlc" ? Standard::Rddlc : Standard::PyRddlGym;
    phase_ = Phase::Running;
    return {{"capabilities", capabilities()},
            {"serverInfo", {{"name", "rddl lsp"}, {"version", version}}}};
}

void Session::notice(const std::string& method, const Json& params) {
    if (method == "exit") has_ended_ = true;
    if (phase_ != Phase::Running) return;
    if (method == "textDocument/didOpen") {
        const Json& document = params.at("textDocument");
        workspace_.open(document.at("uri"), document.value("version", std::int64_t{0}),
                        document.at("text"));
    } else if (method == "textDocument/didChange") {
        const Json& document = params.at("textDocument");
        workspace_.change(document.at("uri"), document.value("version", std::int64_t{0}),
                          params.at("contentChanges"));
    } else if (method == "textDocument/didClose") {
        workspace_.close(params.at("textDocument").at("uri"));
    } else if (method != "textDocument/didSave" && method != "workspace/didChangeWatchedFiles") {
        return;
    }
    has_changed_ = true;
}

FilePtr Session::file_of(const Json& params) const {
    return workspace_.find(params.at("textDocument").at("uri"));
}

const FileChecks& Session::checks_of(const File& file) const {
    static const FileChecks none;
    const auto found = checks_.find(file.uri);
    const bool is_current = found != checks_.end() && found->second.version == file.version;
    return is_current ? found->second : none;
}

Json Session::answer(const std::string& method, const Json& params) {
    if (method == "initialize") return initialize(params);
    if (phase_ == Phase::Start) throw Refusal("the server is not initialized");
    if (phase_ == Phase::ShutDown) throw Refusal("the server is shut down");
    if (method == "shutdown") {
        phase_ = Phase::ShutDown;
        return nullptr;
    }
    if (!method.starts_with("textDocument/")) throw UnknownMethod{};
    const FilePtr file = file_of(params);
    if (!file) return nullptr;
    if (method == "textDocument/documentSymbol") return document_symbols(*file);
    if (method == "textDocument/formatting") return formatting(*file, standard_);
    if (method == "textDocument/codeAction")
        return quick_fixes(checks_of(*file), params.at("range"));
    const Lookup lookup(file, workspace_.family_of(file));
    if (method == "textDocument/inlayHint")
        return inlay_hints(lookup, file->text.place(params.at("range")));
    if (!params.contains("position")) throw UnknownMethod{};
    const std::uint32_t offset = file->text.offset(params.at("position"));
    if (method == "textDocument/hover") return hover(lookup, offset, checks_of(*file));
    if (method == "textDocument/definition") return definition(lookup, offset);
    if (method == "textDocument/references")
        return references(lookup, offset,
                          params.value("/context/includeDeclaration"_json_pointer, true));
    if (method == "textDocument/documentHighlight") return highlights(lookup, offset);
    if (method == "textDocument/completion") return completion(lookup, offset, standard_);
    if (method == "textDocument/prepareRename") return prepare_rename(lookup, offset);
    if (method == "textDocument/rename") return rename(lookup, offset, params.at("newName"));
    throw UnknownMethod{};
}

// --------------------------------------------------------------------------------- diagnostics

bool Session::take_change() {
    return std::exchange(has_changed_, false);
}

CheckRequest Session::check_request() const {
    return lsp::check_request(workspace_, standard_);
}

std::vector<Json> Session::publish(Checks checks) {
    std::vector<Json> messages;
    const auto send = [&](const std::string& uri, const FileChecks& found) {
        Json params = {{"uri", uri}, {"diagnostics", found.diagnostics}};
        if (found.version) params["version"] = *found.version;
        messages.push_back(notification("textDocument/publishDiagnostics", std::move(params)));
    };
    // Files that are not checked any more lose their diagnostics.
    for (const auto& [uri, before] : checks_)
        if (!before.diagnostics.empty() && !checks.contains(uri)) send(uri, {});
    for (const auto& [uri, found] : checks) {
        const FilePtr file = workspace_.find(uri);
        const bool is_stale = file && file->version != found.version;
        const auto before = checks_.find(uri);
        const bool had_some = before != checks_.end() && !before->second.diagnostics.empty();
        if (is_stale || (!file && found.diagnostics.empty() && !had_some)) continue;
        send(uri, found);
    }
    checks_ = std::move(checks);
    return messages;
}

}  // namespace rddlc::lsp

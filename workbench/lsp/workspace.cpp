#include "lsp/workspace.hpp"

#include "support/failure.hpp"
#include "support/files.hpp"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

namespace rddlc::lsp {

namespace fs = std::filesystem;

namespace {

// Folders of more files, and files of more bytes, are not searched.
constexpr std::size_t most_files = 500;
constexpr std::uintmax_t most_bytes = std::uintmax_t{16} << 20;

// "instance10" behind "instance9".
bool in_natural_order(const FilePtr& a, const FilePtr& b) {
    const auto key = [](const FilePtr& file) {
        const std::string stem = file->path.stem().string();
        return std::pair(stem.size(), stem);
    };
    return key(a) < key(b);
}

std::set<std::string_view> domains_of(const File& file) {
    std::set<std::string_view> names;
    for (const Block& block : file.outline.blocks) {
        if (block.kind == Meaning::Domain) names.insert(block.name.text);
        if (!block.domain.empty()) names.insert(block.domain);
    }
    return names;
}

bool belongs_to(const File& file, const std::set<std::string_view>& domains) {
    return std::ranges::any_of(domains_of(file),
                               [&](std::string_view name) { return domains.contains(name); });
}

// The file to use if several declare it: the one that the user asked about, an open one,
// domain.rddl, any.
int rank_of_domain(const File& file, const File& asked) {
    if (file.uri == asked.uri) return 0;
    if (file.version) return 1;
    return file.path.stem() == "domain" ? 2 : 3;
}

}  // namespace

File::File(std::string where, std::optional<std::int64_t> number, std::string content)
    : uri(std::move(where)),
      path(path_of(uri).value_or(uri)),
      version(number),
      text(std::move(content)),
      outline(outline_of(text.string())) {}

std::vector<FilePtr> Family::all() const {
    std::vector<FilePtr> files = others;
    if (domain) files.insert(files.begin(), domain);
    return files;
}

// --------------------------------------------------------------------------------- open files

void Workspace::open(const std::string& uri, std::int64_t version, std::string text) {
    open_[uri] = std::make_shared<const File>(uri, version, std::move(text));
}

void Workspace::change(const std::string& uri, std::int64_t version, const Json& changes) {
    const FilePtr before = find(uri);
    if (!before) return;
    Text text(before->text.string());
    for (const Json& each : changes) {
        std::string changed = each.at("text").get<std::string>();
        if (each.contains("range")) {
            const Place place = text.place(each.at("range"));
            std::string whole = text.string();
            whole.replace(place.begin, place.end - place.begin, changed);
            changed = std::move(whole);
        }
        text = Text(std::move(changed));
    }
    open(uri, version, text.string());
}

void Workspace::close(const std::string& uri) {
    open_.erase(uri);
}

FilePtr Workspace::find(const std::string& uri) const {
    const auto found = open_.find(uri);
    return found == open_.end() ? nullptr : found->second;
}

std::vector<FilePtr> Workspace::open_files() const {
    std::vector<FilePtr> files;
    for (const auto& [uri, file] : open_) files.push_back(file);
    return files;
}

// ----------------------------------------------------------------------------------- families

Family Workspace::family_of(const FilePtr& file) const {
    const std::set<std::string_view> domains = domains_of(*file);
    std::vector<FilePtr> files;
    Family family;
    for (const FilePtr& each : files_around(*file)) {
        const bool belongs = is_one_problem_ || belongs_to(*each, domains);
        if (each->uri == file->uri || belongs) files.push_back(each);
        if (each->outline.has(Meaning::Domain)) family.domains_around.push_back(each);
    }
    for (const FilePtr& each : files) {
        const bool declares = std::ranges::any_of(each->outline.blocks, [&](const Block& block) {
            const bool is_named = is_one_problem_ || domains.contains(block.name.text);
            return block.kind == Meaning::Domain && is_named;
        });
        const bool is_better =
            declares && (!family.domain ||
                         rank_of_domain(*each, *file) < rank_of_domain(*family.domain, *file));
        if (is_better) family.domain = each;
    }
    for (const FilePtr& each : files) {
        const bool is_other_domain = each->outline.has(Meaning::Domain) && each->uri != file->uri;
        if (each != family.domain && !is_other_domain) family.others.push_back(each);
    }
    return family;
}

// Open files, then those of the folder that are not open.
std::vector<FilePtr> Workspace::files_around(const File& file) const {
    std::vector<FilePtr> files = open_files();
    const fs::path folder = file.path.parent_path();
    if (!path_of(file.uri)) return files;
    std::vector<FilePtr> closed;
    std::error_code error;
    std::size_t count = 0;
    for (fs::directory_iterator each(folder, error), end; !error && each != end;
         each.increment(error)) {
        if (each->path().extension() != ".rddl" || ++count > most_files) continue;
        const std::string uri = uri_of(each->path().lexically_normal());
        const bool is_open = std::ranges::any_of(
            files, [&](const FilePtr& one) { return one->path == each->path(); });
        if (is_open) continue;
        if (FilePtr read_file = read(each->path())) closed.push_back(std::move(read_file));
    }
    std::ranges::sort(closed, in_natural_order);
    files.insert(files.end(), closed.begin(), closed.end());
    return files;
}

FilePtr Workspace::read(const fs::path& path) const {
    std::error_code error;
    const auto time = fs::last_write_time(path, error);
    if (error || !fs::is_regular_file(path, error) || fs::file_size(path, error) > most_bytes)
        return nullptr;
    OnDisk& known = on_disk_[path];
    if (known.file && known.time == time) return known.file;
    known.time = time;
    try {
        known.file = std::make_shared<const File>(uri_of(path), std::nullopt,
                                                  rddlc::read_file(path, most_bytes));
    } catch (const Failure&) {
        known.file = nullptr;
    }
    return known.file;
}

}  // namespace rddlc::lsp

#include "lsp/lookup.hpp"

#include <algorithm>

namespace rddlc::lsp {

Lookup::Lookup(FilePtr file, Family family)
    : file_(std::move(file)), family_(std::move(family)), files_(family_.all()) {}

std::optional<FluentSite> Lookup::fluent(std::string_view name) const {
    for (const FluentSite& each : fluents())
        if (each.declaration->name.text == name) return each;
    return std::nullopt;
}

std::optional<TypeSite> Lookup::type(std::string_view name) const {
    for (const TypeSite& each : types())
        if (each.declaration->name.text == name) return each;
    return std::nullopt;
}

std::vector<FluentSite> Lookup::fluents() const {
    std::vector<FluentSite> all;
    for (const FilePtr& each : files_)
        for (const FluentDeclaration& fluent : each->outline.fluents)
            all.push_back({each, &fluent});
    return all;
}

std::vector<TypeSite> Lookup::types() const {
    std::vector<TypeSite> all;
    for (const FilePtr& each : files_)
        for (const TypeDeclaration& type : each->outline.types) all.push_back({each, &type});
    return all;
}

std::string_view Lookup::type_of_object(std::string_view name) const {
    const auto is_it = [&](const Name& each) {
        return each.text == name;
    };
    for (const TypeSite& each : types())
        if (each.declaration->members && std::ranges::any_of(*each.declaration->members, is_it))
            return each.declaration->name.text;
    for (const FilePtr& each : files_)
        for (const ObjectList& list : each->outline.lists)
            if (std::ranges::any_of(list.objects, is_it)) return list.type.text;
    return {};
}

// A parameter of a CPF has the place of the type in the fluent's declaration.
std::string_view Lookup::type_of_binding(const Binding& binding) const {
    if (!binding.type.empty()) return binding.type;
    const auto& occurrences = file_->outline.occurrences;
    const auto name = std::ranges::find_if(occurrences, [&](const Occurrence& each) {
        return each.meaning == Meaning::Fluent && each.name.place.begin == binding.scope.begin;
    });
    if (name == occurrences.end()) return {};
    const auto declared = fluent(name->name.text);
    if (!declared) return {};
    const auto index = std::ranges::count_if(file_->outline.bindings, [&](const Binding& other) {
        return other.scope == binding.scope &&
               other.variable.place.begin < binding.variable.place.begin;
    });
    const auto& parameters = declared->declaration->parameters;
    const auto at = static_cast<std::size_t>(index);
    return at < parameters.size() ? parameters[at].text : std::string_view();
}

// ------------------------------------------------------------------------------------ symbols

Meaning Lookup::meaning_of(const Occurrence& occurrence) const {
    if (occurrence.meaning != Meaning::FluentOrObject) return occurrence.meaning;
    return fluent(occurrence.name.text) ? Meaning::Fluent : Meaning::Object;
}

std::optional<Symbol> Lookup::symbol_at(std::uint32_t offset) const {
    for (const Occurrence& each : file_->outline.occurrences) {
        Place place = each.name.place;
        const bool has_mark = place.begin > 0 && (file_->text.string()[place.begin - 1] == '?' ||
                                                  file_->text.string()[place.begin - 1] == '@');
        if (has_mark) --place.begin;
        if (place.touches(offset))
            return Symbol{meaning_of(each), each.name.text, each.name.place, each.binding};
    }
    return std::nullopt;
}

std::vector<Site> Lookup::sites_of(const Symbol& symbol, bool declarations_only) const {
    std::vector<Site> sites;
    const bool is_variable = symbol.meaning == Meaning::Variable;
    for (const FilePtr& each : files_) {
        if (is_variable && each != file_) continue;
        const auto& outline = each->outline;
        // The values of an instance are many: declared names of fluents are compared once.
        const bool is_fluent = symbol.meaning == Meaning::Fluent;
        for (const Occurrence& one : outline.occurrences) {
            if (one.name.text != symbol.name) continue;
            const bool is_bare = one.meaning == Meaning::FluentOrObject;
            const bool is_same = is_bare && !is_variable
                                     ? meaning_of(one) == symbol.meaning
                                     : one.meaning == symbol.meaning ||
                                           (is_fluent && one.meaning == Meaning::Fluent);
            const bool is_bound_alike = !is_variable || one.binding == symbol.binding;
            if (is_same && is_bound_alike && (one.declares || !declarations_only))
                sites.push_back({each, one.name.place});
        }
    }
    return sites;
}

// ------------------------------------------------------------------------------------ objects

// The instance of the file, else the first one that is open or in the folder, with its non-fluents.
std::vector<FilePtr> Lookup::files_of_the_instance() const {
    const auto has_objects = [](const FilePtr& each) {
        return !each->outline.lists.empty();
    };
    if (has_objects(file_)) return {file_};
    const auto is_instance = [](const FilePtr& each) {
        return each->outline.has(Meaning::Instance);
    };
    const auto instance = is_instance(file_) ? std::ranges::find(files_, file_)
                                             : std::ranges::find_if(files_, is_instance);
    std::vector<FilePtr> all;
    if (instance != files_.end()) {
        all.push_back(*instance);
        for (const Block& block : (*instance)->outline.blocks)
            for (const FilePtr& each : files_)
                if (!block.non_fluents.empty() && each != *instance &&
                    each->outline.find_block(Meaning::NonFluents, block.non_fluents))
                    all.push_back(each);
    }
    return all;
}

std::optional<std::vector<std::string_view>> Lookup::objects_of(std::string_view type_name) const {
    std::vector<std::string_view> names;
    const auto declared = type(type_name);
    if (declared && declared->declaration->members) {
        for (const Name& each : *declared->declaration->members) names.push_back(each.text);
        return names;
    }
    for (const FilePtr& each : files_of_the_instance())
        for (const ObjectList& list : each->outline.lists)
            if (list.type.text == type_name) {
                names.clear();  // the last list counts
                for (const Name& one : list.objects) names.push_back(one.text);
            }
    if (names.empty()) return std::nullopt;
    return names;
}

std::optional<double> Lookup::groundings_of(const FluentDeclaration& declaration) const {
    constexpr double most = 9e15;
    double count = 1;
    for (const Name& parameter : declaration.parameters) {
        const auto objects = objects_of(parameter.text);
        if (!objects) return std::nullopt;
        count *= static_cast<double>(objects->size());
    }
    if (count > most) return std::nullopt;
    return count;
}

}  // namespace rddlc::lsp

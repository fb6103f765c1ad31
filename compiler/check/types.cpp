#include "check/types.hpp"

#include "model/expression_text.hpp"

#include <fmt/format.h>

namespace rddlc::checking {
namespace {

using ObjectLists = std::unordered_map<std::string, const ast::ObjectList*>;

// The last list of a type that is listed twice counts.
ObjectLists collect_lists(const ast::Objects* objects, Context& context) {
    ObjectLists lists;
    if (!objects) return lists;
    for (const ast::ObjectList& list : objects->lists) {
        const auto [entry, is_new] = lists.try_emplace(list.type.text, &list);
        if (is_new) continue;
        context.report(diagnose(repeated_section, entry->second->type.span,
                                fmt::format("these objects of '{}' are ignored: a later list "
                                            "replaces them",
                                            list.type.text))
                           .note(list.type.span, "the list that counts"));
        entry->second = &list;
    }
    return lists;
}

void add_objects(model::TypeId id, const std::vector<ast::Name>& objects, Context& context) {
    model::Type& type = context.model.types[id];
    for (const ast::Name& object : objects) {
        const auto index = static_cast<std::int64_t>(type.objects.size());
        const auto [entry, is_new] =
            context.names.objects.try_emplace(object.text, Object{id, index, object.span});
        if (is_new) {
            type.objects.push_back(object.text);
            continue;
        }
        const Object& first = entry->second;
        const std::string message =
            first.type == id
                ? fmt::format("object '{}' occurs twice in type '{}'", object.text, type.name)
                : fmt::format("object '{}' belongs to type '{}' already", object.text,
                              context.type(first.type).name);
        context.report(diagnose(repeated_object, object.span, message)
                           .note(first.span, fmt::format("'{}' first listed here", object.text)));
    }
}

// Declares the type without its objects.
std::optional<model::TypeId> declare_type(const ast::TypeDeclaration& declaration,
                                          Context& context) {
    const std::string& name = declaration.name.text;
    const auto id = static_cast<model::TypeId>(context.model.types.size());
    const auto [entry, is_new] = context.names.types.try_emplace(name, id);
    if (!is_new) {
        context.report(diagnose(repeated_type, declaration.name.span,
                                fmt::format("type '{}' is declared twice", name))
                           .note(context.type(entry->second).span, "first declared here"));
        return std::nullopt;
    }
    context.model.types.push_back(
        {name, declaration.members.has_value(), {}, declaration.name.span});
    return id;
}

void add_listed_objects(model::TypeId id, const ObjectLists& lists, const Blocks& blocks,
                        Context& context) {
    const model::Type& type = context.type(id);
    const auto list = lists.find(type.name);
    if (list != lists.end() && type.enumerated) {
        context.report(diagnose(ignored_objects, list->second->type.span,
                                fmt::format("these objects are ignored: type '{}' is enumerated "
                                            "in the domain",
                                            type.name))
                           .note(type.span, "declared here"));
    } else if (list != lists.end()) {
        add_objects(id, list->second->objects, context);
    } else if (!blocks.has_objects && !type.enumerated) {
        context.names.open_types.insert(id);
    } else if (!type.enumerated) {
        context.names.broken_types.insert(id);
        context.report(
            diagnose(type_without_objects, type.span,
                     fmt::format("type '{}' has no objects in the instance", type.name))
                .with_hint(fmt::format("add '{} : {{ ... }};' to its 'objects'", type.name)));
    }
}

void report_undeclared(const ast::Objects& objects, Context& context) {
    for (const ast::ObjectList& list : objects.lists)
        if (!context.names.types.contains(list.type.text))
            context.report(
                diagnose(objects_of_unknown_type, list.type.span,
                         fmt::format("type '{}' is not declared in the domain", list.type.text))
                    .with_hint(suggestion(context, list.type.text, list.type.span,
                                          [&] { return keys(context.names.types); })));
}

}  // namespace

void declare_types(const Blocks& blocks, Context& context) {
    const ObjectLists lists = collect_lists(blocks.objects, context);
    // The domain's members first, so that a clash is reported where the instance causes it.
    if (blocks.types)
        for (const ast::TypeDeclaration& declaration : blocks.types->declarations)
            if (const auto id = declare_type(declaration, context); id && declaration.members)
                add_objects(*id, *declaration.members, context);
    for (model::TypeId id = 0; id < context.model.types.size(); ++id)
        add_listed_objects(id, lists, blocks, context);
    if (blocks.objects) report_undeclared(*blocks.objects, context);
}

std::optional<model::TypeId> resolve_type(const ast::Name& name, Context& context) {
    if (const model::TypeId* id = find(context.names.types, name.text)) return *id;
    const bool primitive = name.text == "bool" || name.text == "int" || name.text == "real";
    const Hint hint =
        primitive
            ? "only object types and enumerated types have members to range over"
            : suggestion(context, name.text, name.span, [&] { return keys(context.names.types); });
    const std::string message = primitive ? fmt::format("'{}' is not a type of objects", name.text)
                                          : fmt::format("type '{}' is not declared", name.text);
    context.report(diagnose(unknown_type, name.span, message).with_hint(hint));
    return std::nullopt;
}

std::string describe(const Context& context, model::ValueType type) {
    if (type.kind == model::ValueType::Kind::Object)
        return fmt::format("an object of type '{}'", context.type(type.type).name);
    return model::text_of(context.model, type);
}

}  // namespace rddlc::checking

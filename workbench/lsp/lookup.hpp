// Names of a family of files: what they mean, and how many objects there are.
#pragma once

#include "lsp/workspace.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::lsp {

// A place of a file.
struct Site {
    FilePtr file;
    Place place;
};

struct FluentSite {
    FilePtr file;
    const FluentDeclaration* declaration;
};
struct TypeSite {
    FilePtr file;
    const TypeDeclaration* declaration;
};

// The name at a cursor.
struct Symbol {
    Meaning meaning;  // never FluentOrObject
    std::string_view name;
    Place place;
    std::size_t binding = 0;  // of a variable
};

// Holds for one request.
class Lookup {
  public:
    Lookup(FilePtr file, Family family);

    const FilePtr& file() const { return file_; }
    const std::vector<FilePtr>& files() const { return files_; }
    const std::vector<FilePtr>& domains_around() const { return family_.domains_around; }

    std::optional<Symbol> symbol_at(std::uint32_t offset) const;
    // The declaration of the symbol, if `declarations_only`, or all that mention it.
    std::vector<Site> sites_of(const Symbol& symbol, bool declarations_only) const;

    std::optional<FluentSite> fluent(std::string_view name) const;
    std::optional<TypeSite> type(std::string_view name) const;
    std::vector<FluentSite> fluents() const;
    std::vector<TypeSite> types() const;
    // The type of an object or value.
    std::string_view type_of_object(std::string_view name) const;
    // The type of a variable: as it is written, or as the parameter of the CPF that binds it.
    std::string_view type_of_binding(const Binding& binding) const;

    // Members of an enumerated type, or the objects of the instance that counts here; nothing
    // without such an instance.
    std::optional<std::vector<std::string_view>> objects_of(std::string_view type) const;
    // The number of groundings; nothing if it is not known, or larger than a double can count.
    std::optional<double> groundings_of(const FluentDeclaration& fluent) const;

  private:
    Meaning meaning_of(const Occurrence& occurrence) const;
    std::vector<FilePtr> files_of_the_instance() const;

    FilePtr file_;
    Family family_;
    std::vector<FilePtr> files_;
};

}  // namespace rddlc::lsp

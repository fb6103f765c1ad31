#include "model/fingerprint.hpp"

#include "model/print.hpp"
#include "support/text_hash.hpp"

namespace rddlc::model {

// The printed model shows the first few objects and values alone, so all of them are added.
std::uint64_t fingerprint(const Model& model) {
    TextHash hash;
    hash.add(print_problem(model));
    for (const Type& type : model.types)
        for (const std::string& object : type.objects) hash.add(object);
    for (const Fluent& fluent : model.domain_fluents())
        if (!fluent.values.empty()) hash.add(hash_of(fluent.values));
    return hash.value();
}

}  // namespace rddlc::model

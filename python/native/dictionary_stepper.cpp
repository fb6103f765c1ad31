#include "native/dictionary_stepper.hpp"

#include "native/dictionary_reader.hpp"
#include "native/dictionary_writer.hpp"
#include "native/env_pool.hpp"

namespace nb = nanobind;

namespace rddlc::python {

namespace {

// One call of Python, since calls of the three parts take longer than most steps do.
class DictionaryStepper {
  public:
    DictionaryStepper(EnvPool& batch, DictionaryWriter& writer, DictionaryReader& reader)
        : batch_(batch), writer_(writer), reader_(reader) {}

    // The result of env.step(); None, and nothing is done, for what the writer does not take.
    nb::object step(nb::handle action) {
        batch_.finish();
        if (!writer_.write(action)) return nb::none();
        batch_.step({});
        return result();
    }

  private:
    nb::tuple result() {
        const auto& arrays = batch_.arrays();
        const std::uint8_t causes = arrays.causes[0];
        const bool is_terminated = (causes & RDDL_TERMINATED) != 0;
        return nb::make_tuple(reader_.read(), arrays.rewards[0], is_terminated,
                              (causes & ~RDDL_TERMINATED) != 0, nb::dict());
    }

    EnvPool& batch_;
    DictionaryWriter& writer_;
    DictionaryReader& reader_;
};

}  // namespace

void add_dictionary_stepper(nb::module_& module) {
    nb::class_<DictionaryStepper>(module, "DictionaryStepper",
                                  "Steps the first environment by dictionaries.")
        .def(nb::init<EnvPool&, DictionaryWriter&, DictionaryReader&>(), nb::arg("batch"),
             nb::arg("writer"), nb::arg("reader"), nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(),
             nb::keep_alive<1, 4>())
        .def("step", &DictionaryStepper::step, nb::arg("action").none());
}

}  // namespace rddlc::python

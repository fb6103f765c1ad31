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
        : batch_(batch), writer_(writer), reader_(reader), reader_object_(nb::find(reader)) {}

    // The result of env.step(); None, and nothing is done, for what the writer does not take.
    nb::object step(nb::handle action) {
        batch_.finish();
        if (!writer_.write(action)) return nb::none();
        batch_.step({});
        return result();
    }

    // Python's collector sees through the reader to the dictionaries that programs hold.
    int traverse(visitproc visit, void* arg) const {
        Py_VISIT(reader_object_.ptr());
        return 0;
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
    nb::object reader_object_;
};

int traverse_stepper(PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    return nb::inst_ready(self) ? nb::inst_ptr<DictionaryStepper>(self)->traverse(visit, arg) : 0;
}

}  // namespace

void add_dictionary_stepper(nb::module_& module) {
    PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse_stepper)},
                           {0, nullptr}};  // the reader's tp_clear breaks cycles
    nb::class_<DictionaryStepper>(module, "DictionaryStepper", nb::type_slots(slots),
                                  "Steps the first environment by dictionaries.")
        .def(nb::init<EnvPool&, DictionaryWriter&, DictionaryReader&>(), nb::arg("batch"),
             nb::arg("writer"), nb::arg("reader"), nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>())
        .def("step", &DictionaryStepper::step, nb::arg("action").none());
}

}  // namespace rddlc::python

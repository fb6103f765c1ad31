// The native part of the Python package; users import python/rddlc/.
#include "native/choice_writer.hpp"
#include "native/derivatives.hpp"
#include "native/dictionary_reader.hpp"
#include "native/dictionary_stepper.hpp"
#include "native/dictionary_writer.hpp"
#include "native/enumeration.hpp"
#include "native/env_pool.hpp"
#include "native/feature_writer.hpp"
#include "native/learners.hpp"
#include "native/numpy_numbers.hpp"
#include "native/painter.hpp"
#include "native/problem.hpp"

NB_MODULE(_native, module) {
    nanobind::set_leak_warnings(false);  // what a program keeps until its end is no mistake
    module.doc() = "Simulators of RDDL problems, for the package rddlc.";
    rddlc::python::import_numpy();
    rddlc::python::add_problem(module);
    rddlc::python::add_env_pool(module);
    rddlc::python::add_choice_writer(module);
    rddlc::python::add_feature_writer(module);
    rddlc::python::add_dictionary_reader(module);
    rddlc::python::add_dictionary_writer(module);
    rddlc::python::add_dictionary_stepper(module);
    rddlc::python::add_enumeration(module);
    rddlc::python::add_painter(module);
    rddlc::python::add_learners(module);
    rddlc::python::add_derivatives(module);
}

// The native part of the Python package; python/rddlc/ is what people use.
#include "native/batch.hpp"
#include "native/painter.hpp"
#include "native/problem.hpp"

NB_MODULE(_native, module) {
    module.doc() = "Simulators of RDDL problems, for the package rddlc.";
    rddlc::python::add_problem(module);
    rddlc::python::add_batch(module);
    rddlc::python::add_painter(module);
}

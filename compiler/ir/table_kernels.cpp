#include "ir/table_kernels.hpp"

#include <rddl/random/distributions/vectors.hpp>
#include <rddl/values/linear_algebra.hpp>

namespace rddlc::ir {
namespace {

template <class T>
T* elements(std::byte* table) {
    return reinterpret_cast<T*>(table);
}

rddl::MatrixView matrix(std::byte* table, std::int64_t size) {
    return {elements<double>(table), size};
}

}  // namespace

void call_on_tables(MatrixOperator op, const TableArguments& arguments, rddl::Place, Context&) {
    const std::int64_t n = arguments.size;
    rddl::MatrixView input = matrix(arguments.inputs[0], n);
    rddl::MatrixView output = matrix(arguments.output, n);
    switch (op) {
        case MatrixOperator::Determinant:
            return rddl::determinant(n, input, *output.first);
        case MatrixOperator::Inverse:
            return rddl::inverse(n, input, output);
        case MatrixOperator::PseudoInverse: {
            rddl::MatrixView room = matrix(arguments.inputs[1], n);
            return rddl::pseudo_inverse(n, input, room, output);
        }
        case MatrixOperator::Cholesky:
            return rddl::cholesky(n, input, output);
    }
}

void call_on_tables(VectorDistribution distribution, const TableArguments& arguments,
                    rddl::Place place, Context& context) {
    namespace sample = rddl::sample;
    const std::int64_t n = arguments.size;
    const double* vector = elements<const double>(arguments.inputs[0]);
    const rddl::MatrixView factor = matrix(arguments.inputs[1], n);
    double* draw = elements<double>(arguments.output);
    switch (distribution) {
        case VectorDistribution::MultivariateNormal:
            return sample::multivariate_normal(context, place, n, vector, factor, draw);
        case VectorDistribution::MultivariateStudent:
            return sample::multivariate_student(context, place, n, arguments.real_scalar, vector,
                                                factor, draw);
        case VectorDistribution::Dirichlet:
            return sample::dirichlet(context, place, n, vector, draw);
        case VectorDistribution::Multinomial: {
            std::int64_t* counts = elements<std::int64_t>(arguments.output);
            return sample::multinomial(context, place, n, arguments.int_scalar, vector, counts);
        }
    }
}

}  // namespace rddlc::ir

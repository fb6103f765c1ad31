// The matrix products of PPO alone, by OpenBLAS: a lower bound of the time of every implementation
// that makes them. Two networks 3-64-64-1 in the shape of rltools.py: 4 environments x 1,024 steps,
// 2 epochs of minibatches of 256. rltools.py compiles and runs it.
//
//   products UPDATES
#include <cblas.h>

#include <cstdlib>
#include <vector>

namespace {

constexpr int environments = 4, rollout = 1024, epochs = 2, minibatch = 256;
constexpr int widths[] = {3, 64, 64, 1};

// c (+)= a b, all of them row-major; a or b may be transposed.
void product(CBLAS_TRANSPOSE a_turned, CBLAS_TRANSPOSE b_turned, int rows, int columns, int depth,
             const float* a, const float* b, float* c, bool adds) {
    cblas_sgemm(CblasRowMajor, a_turned, b_turned, rows, columns, depth, 1, a,
                a_turned == CblasTrans ? rows : depth, b, b_turned == CblasTrans ? depth : columns,
                adds ? 1 : 0, c, columns);
}

struct Network {
    std::vector<float> weights[3], gradients[3], values[4], d_values[4];

    Network() {
        for (int l = 0; l < 4; ++l)
            for (auto* each : {&values[l], &d_values[l]})
                each->assign(minibatch * widths[l], 0.01f);
        for (int l = 0; l < 3; ++l)
            for (auto* each : {&weights[l], &gradients[l]})
                each->assign(widths[l] * widths[l + 1], 0.01f);
    }
    void forward(int samples) {
        for (int l = 0; l < 3; ++l)
            product(CblasNoTrans, CblasNoTrans, samples, widths[l + 1], widths[l], values[l].data(),
                    weights[l].data(), values[l + 1].data(), false);
    }
    void backward(int samples) {
        for (int l = 2; l >= 0; --l) {
            product(CblasTrans, CblasNoTrans, widths[l], widths[l + 1], samples, values[l].data(),
                    d_values[l + 1].data(), gradients[l].data(), false);
            if (l > 0)
                product(CblasNoTrans, CblasTrans, samples, widths[l], widths[l + 1],
                        d_values[l + 1].data(), weights[l].data(), d_values[l].data(), false);
        }
    }
};

}  // namespace

int main(int, char** words) {
    Network policy, value;
    for (long updates = std::atol(words[1]); updates > 0; --updates) {
        for (int t = 0; t < rollout; ++t) policy.forward(environments);
        const int minibatches = environments * rollout / minibatch;
        for (int m = 0; m < minibatches; ++m) value.forward(minibatch);
        for (int m = 0; m < epochs * minibatches; ++m)
            for (Network* network : {&policy, &value}) {
                network->forward(minibatch);
                network->backward(minibatch);
            }
    }
}

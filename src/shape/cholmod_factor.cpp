// SPDX-License-Identifier: GPL-3.0-or-later
//
// Y. Chen, T. Davis, W. Hager, S. Rajamanickam, "Algorithm 887: CHOLMOD, supernodal sparse Cholesky factorization and
// update/downdate" (2008).
//
// The library is opened when it is first needed, for it brings BLAS along: OpenBLAS starts threads and takes tens of
// megabytes as soon as it is loaded, 3 ms of every run, and where memory is limited it waits for it for ever.

#include "shape/cholmod_factor.h"

#include <dlfcn.h>

#include <Eigen/CholmodSupport>
#include <string>

#include "droplet/error.h"

namespace droplet {
namespace {

/// The functions used, from the library whose header was compiled against.
class Library {
public:
    Library()
    {
        const std::string name = "libcholmod.so." + std::to_string(CHOLMOD_MAIN_VERSION);
        library_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        find("cholmod_start", start);
        find("cholmod_finish", finish);
        find("cholmod_analyze", analyze);
        find("cholmod_factorize", factorize);
        find("cholmod_solve", solve);
        find("cholmod_free_factor", free_factor);
        find("cholmod_free_dense", free_dense);
    }

    decltype(&cholmod_start) start = nullptr;
    decltype(&cholmod_finish) finish = nullptr;
    decltype(&cholmod_analyze) analyze = nullptr;
    decltype(&cholmod_factorize) factorize = nullptr;
    decltype(&cholmod_solve) solve = nullptr;
    decltype(&cholmod_free_factor) free_factor = nullptr;
    decltype(&cholmod_free_dense) free_dense = nullptr;

private:
    template <typename Function>
    void find(const char* name, Function& function)
    {
        void* const symbol = library_ == nullptr ? nullptr : dlsym(library_, name);
        if (symbol == nullptr) {
            throw Error(ErrorCode::InvalidArgument,
                        "solver cholmod must be installed: " + std::string(library_ == nullptr ? dlerror() : name));
        }
        function = reinterpret_cast<Function>(symbol);
    }

    void* library_ = nullptr;  // never closed: what it started goes on
};

}  // namespace

struct CholmodFactor::State {
    Library library;
    cholmod_common common{};
    cholmod_factor* factor = nullptr;
};

CholmodFactor::CholmodFactor() : state_(std::make_unique<State>())
{
    cholmod_common& common = state_->common;
    state_->library.start(&common);
    common.print = 0;  // what goes wrong is ours to tell
    common.supernodal = CHOLMOD_SUPERNODAL;
    // Nested dissection takes longer than it saves up to a million triangles.
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
}

CholmodFactor::~CholmodFactor()
{
    state_->library.free_factor(&state_->factor, &state_->common);
    state_->library.finish(&state_->common);
}

void CholmodFactor::analyzePattern(const Eigen::SparseMatrix<double>& matrix)
{
    state_->library.free_factor(&state_->factor, &state_->common);
    cholmod_sparse view = Eigen::viewAsCholmod(matrix.selfadjointView<Eigen::Lower>());
    state_->factor = state_->library.analyze(&view, &state_->common);
}

void CholmodFactor::factorize(const Eigen::SparseMatrix<double>& matrix)
{
    if (state_->factor != nullptr) {
        cholmod_sparse view = Eigen::viewAsCholmod(matrix.selfadjointView<Eigen::Lower>());
        state_->library.factorize(&view, state_->factor, &state_->common);
    }
}

Eigen::ComputationInfo CholmodFactor::info() const
{
    const bool whole = state_->factor != nullptr && state_->factor->minor == state_->factor->n;
    return whole && state_->common.status == CHOLMOD_OK ? Eigen::Success : Eigen::NumericalIssue;
}

Eigen::VectorXd CholmodFactor::solve(const Eigen::VectorXd& right) const
{
    Eigen::VectorXd copy = right;
    cholmod_dense view = Eigen::viewAsCholmod(copy);
    cholmod_dense* solution = state_->library.solve(CHOLMOD_A, state_->factor, &view, &state_->common);
    if (solution == nullptr) {
        return Eigen::VectorXd::Zero(right.size());
    }
    Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(solution->x), right.size());
    state_->library.free_dense(&solution, &state_->common);
    return result;
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/continuum/condensation.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <cholmod.h>

extern "C" {
void dpotri_(const char* triangle, const int* n, double* a, const int* stride, int* info);
// Only OpenBLAS has these; with another BLAS the addresses are null.
[[gnu::weak]] void openblas_set_num_threads(int);
[[gnu::weak]] int openblas_get_num_threads();
}

namespace grainfall::femlink {

namespace {

// Two BLAS threads on matrices of this size take longer than one (measured: two to three times).
class OneBlasThread {
public:
    OneBlasThread() : before_(openblas_get_num_threads ? openblas_get_num_threads() : 0) { set(1); }
    ~OneBlasThread() { set(before_); }
    OneBlasThread(const OneBlasThread&) = delete;
    OneBlasThread& operator=(const OneBlasThread&) = delete;

private:
    static void set(int threads) {
        if (openblas_set_num_threads && threads > 0)
            openblas_set_num_threads(threads);
    }
    int before_;
};

struct Workspace {
    cholmod_common common;
    Workspace() {
        cholmod_start(&common);
        common.supernodal = CHOLMOD_SUPERNODAL;
        common.print = 0;
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_NATURAL;
        common.postorder = 0; // it would move the surface's unknowns from the end
    }
    ~Workspace() { cholmod_finish(&common); }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
};

// A view of Eigen's arrays; CHOLMOD only reads them.
cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower) {
    cholmod_sparse view{};
    view.nrow = lower.rows();
    view.ncol = lower.cols();
    view.nzmax = lower.nonZeros();
    view.p = const_cast<int*>(lower.outerIndexPtr());
    view.i = const_cast<int*>(lower.innerIndexPtr());
    view.x = const_cast<double*>(lower.valuePtr());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
}

} // namespace

std::vector<int> elimination_order(const std::vector<std::vector<int>>& graph, int last) {
    const int count = static_cast<int>(graph.size()), interior = count - last;
    std::vector<int> order(count);
    for (int i = 0; i < count; ++i)
        order[i] = i;
    if (interior < 2)
        return order;
    std::vector<int> start = {0}, rows;
    for (int node = 0; node < interior; ++node) {
        rows.push_back(node);
        for (const int other : graph[node])
            if (other > node && other < interior)
                rows.push_back(other);
        start.push_back(static_cast<int>(rows.size()));
    }
    std::vector<double> values(rows.size(), 1);
    const Eigen::Map<Eigen::SparseMatrix<double>> pattern(interior, interior, static_cast<int>(rows.size()),
                                                          start.data(), rows.data(), values.data());
    Eigen::SparseMatrix<double> lower = pattern;
    cholmod_sparse view = view_of(lower);
    Workspace workspace;
    std::vector<int> dissection(interior);
    if (cholmod_metis(&view, nullptr, 0, 1, dissection.data(), &workspace.common))
        std::copy(dissection.begin(), dissection.end(), order.begin());
    return order;
}

struct DirectFactor::Parts {
    Workspace workspace;
    Eigen::SparseMatrix<double> lower;
    cholmod_factor* factor = nullptr;
    bool done = false;

    explicit Parts(const Eigen::SparseMatrix<double>& matrix) : lower(matrix) {}
    ~Parts() { cholmod_free_factor(&factor, &workspace.common); }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
};

DirectFactor::DirectFactor(const Eigen::SparseMatrix<double>& lower)
    : parts_(std::make_unique<Parts>(lower)) {
    cholmod_sparse view = view_of(parts_->lower);
    parts_->factor = cholmod_analyze(&view, &parts_->workspace.common);
    if (!parts_->factor)
        throw std::runtime_error("the wall's stiffness is too large to be analysed: memory ran out");
}

DirectFactor::~DirectFactor() = default;

std::size_t DirectFactor::bytes() const {
    return parts_->factor->xsize * sizeof(double);
}

bool DirectFactor::is_factorized() const {
    return parts_->done;
}

void DirectFactor::factorize() {
    const OneBlasThread one_thread;
    cholmod_sparse view = view_of(parts_->lower);
    cholmod_factorize(&view, parts_->factor, &parts_->workspace.common);
    const int status = parts_->workspace.common.status;
    if (status == CHOLMOD_NOT_POSDEF)
        throw std::runtime_error("the wall's stiffness is singular: some part of the mesh is not held");
    if (status != CHOLMOD_OK)
        throw std::runtime_error("the wall's stiffness could not be factored: memory ran out");
    parts_->lower.resize(0, 0); // the factor replaces it
    parts_->done = true;
}

Eigen::VectorXd DirectFactor::solve(const Eigen::VectorXd& load) const {
    const OneBlasThread one_thread;
    cholmod_dense right{};
    right.nrow = right.nzmax = right.d = load.size();
    right.ncol = 1;
    right.x = const_cast<double*>(load.data());
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* found = cholmod_solve(CHOLMOD_A, parts_->factor, &right, &parts_->workspace.common);
    if (!found)
        throw std::runtime_error("the wall's displacement could not be computed: memory ran out");
    const Eigen::VectorXd solution =
        Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(found->x), load.size());
    cholmod_free_dense(&found, &parts_->workspace.common);
    return solution;
}

Eigen::MatrixXd DirectFactor::condensed_compliance(int count) const {
    const cholmod_factor& factor = *parts_->factor;
    const auto* super = static_cast<const int*>(factor.super);
    const auto* row_start = static_cast<const int*>(factor.pi);
    const auto* value_start = static_cast<const int*>(factor.px);
    const auto* rows = static_cast<const int*>(factor.s);
    const auto* values = static_cast<const double*>(factor.x);
    const int first = static_cast<int>(factor.n) - count;

    Eigen::MatrixXd compliance = Eigen::MatrixXd::Zero(count, count);
    for (std::size_t s = 0; s < factor.nsuper; ++s) {
        const int height = row_start[s + 1] - row_start[s];
        for (int column = std::max(first, super[s]); column < super[s + 1]; ++column) {
            const double* entries =
                values + value_start[s] + static_cast<std::ptrdiff_t>(column - super[s]) * height;
            for (int k = 0; k < height; ++k) {
                const int row = rows[row_start[s] + k];
                if (row >= column)
                    compliance(row - first, column - first) = entries[k];
            }
        }
    }
    const OneBlasThread one_thread;
    int info = 0;
    dpotri_("L", &count, compliance.data(), &count, &info);
    if (info != 0)
        throw std::runtime_error("the wall's condensed stiffness is singular");
    compliance.triangularView<Eigen::StrictlyUpper>() = compliance.transpose();
    return compliance;
}

} // namespace grainfall::femlink

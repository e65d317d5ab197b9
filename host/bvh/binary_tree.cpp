// Top-down construction of the binary tree, large subtrees as tasks of their own.
#include "host/bvh/binary_tree.h"

#include "host/bvh/split.h"

#include <oneapi/tbb/task_group.h>

#include <atomic>

namespace parhelion {
namespace {

constexpr int binary_leaf_size = 16;  // references that are not divided further
constexpr int task_references = 4096; // subtrees of more are built by tasks of their own
constexpr int deepest_sah = 256;      // below, subtrees are halved: bounds the recursion

class TreeBuilder {
public:
    TreeBuilder(BinaryTree& tree, SplitMethod method) : tree_(tree), method_(method) {
        if (tree.references.size() > parallel_range) scratch_.resize(tree.references.size());
    }

    void build(int index, int first, int count, int depth) {
        BinaryNode& node = tree_.nodes[index];
        std::span<Reference> range(&tree_.references[first], std::size_t(count));
        node = {range_box(range), -1, first, count, -1};
        bool small = count <= BVH_WIDTH;
        if (small && one_kind(range)) node.kind = range.front().kind();
        if (count <= binary_leaf_size && node.kind >= 0) return;
        int left =
            small && node.kind < 0 ? int(split_by_kind(range)) : int(split(range, first, depth));
        node.children = node_count_.fetch_add(2, std::memory_order_relaxed);
        auto build_left = [&] { build(node.children, first, left, depth + 1); };
        auto build_right = [&] { build(node.children + 1, first + left, count - left, depth + 1); };
        if (count > task_references) {
            tbb::task_group group;
            group.run(build_left);
            build_right();
            group.wait();
        } else {
            build_left();
            build_right();
        }
    }

    int node_count() const { return node_count_; }

private:
    std::size_t split(std::span<Reference> range, int first, int depth) {
        if (method_ == SplitMethod::halves || depth >= deepest_sah) return split_in_half(range);
        bool large = range.size() > parallel_range;
        return split_by_surface_area(range, large ? std::span(&scratch_[first], range.size())
                                                  : std::span<Reference>());
    }

    BinaryTree& tree_;
    SplitMethod method_;
    std::vector<Reference> scratch_;
    std::atomic<int> node_count_{1};
};

} // namespace

BinaryTree build_binary_tree(std::vector<Reference> references, SplitMethod method) {
    int count = int(references.size());
    // A node for every reference and one for every division; what is not used is never touched, so
    // it costs no memory.
    BinaryTree tree{std::move(references),
                    std::unique_ptr<BinaryNode[]>(new BinaryNode[2 * std::size_t(count)]), 0};
    TreeBuilder builder(tree, method);
    builder.build(0, 0, count, 0);
    tree.node_count = builder.node_count();
    return tree;
}

} // namespace parhelion

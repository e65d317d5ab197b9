// Top-down construction of the binary tree, large subtrees as tasks of their own.
#include "host/bvh/binary_tree.h"

#include "host/bvh/split.h"
#include "host/parallel.h"

#include <algorithm>
#include <atomic>

namespace parhelion {
namespace {

constexpr int binary_leaf_size = 16;  // references that are not divided further
constexpr int task_references = 4096; // subtrees of more are built by tasks of their own
constexpr int deepest_sah = 256;      // below, subtrees are halved: bounds the recursion

/// A subtree in the making. Its references are in one of two arrays and move to the other whenever
/// they are divided; the same places of the other array are free.
struct Subtree {
    int node, first, count, depth;
    bool moved; ///< the references are in the second array
    RangeBounds bounds;
};

class TreeBuilder {
public:
    TreeBuilder(BinaryTree& tree, SplitMethod method)
        : tree_(tree), method_(method), second_(tree.references.size()) {}

    void build_all() {
        int count = int(tree_.references.size());
        build({0, 0, count, 0, false, range_bounds(tree_.references)});
    }

    int node_count() const { return node_count_; }

private:
    std::span<Reference> references(const Subtree& s, bool second) {
        Reference* all = second ? second_.data() : tree_.references.data();
        return {all + s.first, std::size_t(s.count)};
    }

    void build(const Subtree& s) {
        BinaryNode& node = tree_.nodes[s.node];
        node = {s.bounds.box, -1, s.first, s.count, -1};
        std::span<Reference> range = references(s, s.moved);
        bool small = s.count <= BVH_WIDTH;
        if (small && one_kind(range)) node.kind = range.front().kind();
        if (s.count <= binary_leaf_size && node.kind >= 0) {
            if (s.moved) std::copy(range.begin(), range.end(), references(s, false).begin());
            return;
        }
        bool moved = s.moved;
        Division division = small && node.kind < 0 ? split_by_kind(range) : split(s, moved);
        node.children = node_count_.fetch_add(2, std::memory_order_relaxed);
        int left = int(division.first_count);
        build_both({node.children, s.first, left, s.depth + 1, moved, division.bounds[0]},
                   {node.children + 1, s.first + left, s.count - left, s.depth + 1, moved,
                    division.bounds[1]});
    }

    void build_both(const Subtree& left, const Subtree& right) {
        if (left.count + right.count > task_references) {
            TaskGroup group;
            group.run([&] { build(left); });
            build(right);
            group.wait();
        } else {
            build(left);
            build(right);
        }
    }

    /// `moved` becomes where the parts are.
    Division split(const Subtree& s, bool& moved) {
        if (method_ == SplitMethod::surface_area && s.depth < deepest_sah) {
            Division division =
                split_by_surface_area(references(s, moved), s.bounds, references(s, !moved));
            if (division.first_count > 0) {
                moved = !moved;
                return division;
            }
        }
        return split_in_half(references(s, moved), s.bounds);
    }

    BinaryTree& tree_;
    SplitMethod method_;
    LargeVector<Reference> second_;
    std::atomic<int> node_count_{1};
};

} // namespace

BinaryTree build_binary_tree(LargeVector<Reference> references, SplitMethod method) {
    // A node for every reference and one for every division; what is not used is never touched, so
    // it costs no memory.
    BinaryTree tree{std::move(references), {}};
    tree.nodes.resize(2 * tree.references.size());
    TreeBuilder builder(tree, method);
    builder.build_all();
    tree.nodes.resize(std::size_t(builder.node_count()));
    return tree;
}

} // namespace parhelion

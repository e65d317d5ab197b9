// Numbering of nodes and leaves in the order of the tree, and packing of boxes and primitives into
// rows of 16.
#include "host/bvh/wide_layout.h"

#include "kernels/shared/features.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace parhelion {
namespace {

BvhNode empty_node() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    BvhNode node;
    for (int row = 0; row < 6; row++)
        std::fill_n(node.bounds[row], BVH_WIDTH, row % 2 == 0 ? infinity : -infinity);
    std::fill_n(node.child, BVH_WIDTH, 0);
    return node;
}

class NodeWriter {
public:
    NodeWriter(Bvh& bvh, const BinaryTree& tree, const CollapsePlan& plan)
        : nodes_(bvh.nodes), first_leaf_(int(bvh.leaves.size())), tree_(tree), plan_(plan) {}

    WideTree write() {
        if (is_leaf(0)) return {leaf_code(0), 0, 0, std::move(leaves_)};
        int root = int(nodes_.size());
        Reach reach = write_node(0);
        return {root, reach.depth, reach.stack_entries, std::move(leaves_)};
    }

private:
    struct Reach {
        int depth, stack_entries;
    };
    struct Children {
        std::array<int, BVH_WIDTH> binary;
        int count = 0;
    };

    const CollapseChoice& choice(int binary) const { return plan_.choices[binary]; }
    bool is_leaf(int binary) const { return choice(binary).left_roots[1] == 0; }

    int leaf_code(int binary) {
        const BinaryNode& node = tree_.nodes[binary];
        int leaf = first_leaf_ + int(leaves_.size());
        leaves_.push_back({node.first, node.count});
        return ~((leaf << 2) | node.kind);
    }

    /// The binary nodes that stand for a subtree when it may take up to `roots` places.
    void gather(int binary, int roots, Children& children) const {
        while (roots > 1 && choice(binary).left_roots[roots] == 0)
            roots--;
        if (roots == 1) {
            children.binary[children.count++] = binary;
            return;
        }
        gather_both(binary, roots, children);
    }

    void gather_both(int binary, int roots, Children& children) const {
        int left_roots = choice(binary).left_roots[roots], first = tree_.nodes[binary].children;
        gather(first, left_roots, children);
        gather(first + 1, roots - left_roots, children);
    }

    void write_box(BvhNode& node, int place, const Box& box) const {
        for (int axis = 0; axis < 3; axis++) {
            node.bounds[2 * axis][place] = box.low[axis];
            node.bounds[2 * axis + 1][place] = box.high[axis];
        }
    }

    /// A walk that goes down into one child leaves the others waiting: children - 1 entries a
    /// level.
    Reach write_node(int binary) {
        std::size_t me = nodes_.size();
        nodes_.push_back(empty_node());
        Children children;
        gather_both(binary, BVH_WIDTH, children);
        for (int i = 0; i < children.count; i++) {
            int child = children.binary[i];
            write_box(nodes_[me], i, tree_.nodes[child].box);
            if (is_leaf(child)) nodes_[me].child[i] = leaf_code(child);
        }
        Reach below{0, 0};
        for (int i = 0; i < children.count; i++) {
            if (is_leaf(children.binary[i])) continue;
            nodes_[me].child[i] = int(nodes_.size());
            Reach reach = write_node(children.binary[i]);
            below.depth = std::max(below.depth, reach.depth);
            below.stack_entries = std::max(below.stack_entries, reach.stack_entries);
        }
        return {below.depth + 1, below.stack_entries + children.count - 1};
    }

    CacheLineVector<BvhNode>& nodes_;
    int first_leaf_;
    const BinaryTree& tree_;
    const CollapsePlan& plan_;
    std::vector<LeafRange> leaves_;
};

std::array<float, 9> leaf_column(const PrimitiveRecord& p) {
    if (geometry_kind(p) == geometry_sphere) return {p.ax, p.ay, p.az, p.radius};
    return {p.ax, p.ay, p.az, p.bx, p.by, p.bz, p.cx, p.cy, p.cz};
}

BvhLeaf make_leaf(std::span<const Reference> references,
                  std::span<const PrimitiveRecord> primitives) {
    BvhLeaf leaf{};
    std::fill_n(leaf.primitive, BVH_WIDTH, -1);
    for (std::size_t i = 0; i < references.size(); i++) {
        int number = references[i].primitive();
        std::array<float, 9> column = leaf_column(primitives[std::size_t(number)]);
        for (std::size_t row = 0; row < column.size(); row++)
            leaf.rows[row][i] = column[row];
        leaf.primitive[i] = number;
    }
    return leaf;
}

} // namespace

WideTree append_nodes(Bvh& bvh, const BinaryTree& tree, const CollapsePlan& plan) {
    return NodeWriter(bvh, tree, plan).write();
}

int append_empty_node(Bvh& bvh) {
    bvh.nodes.push_back(empty_node());
    return int(bvh.nodes.size()) - 1;
}

void append_leaves(Bvh& bvh, const BinaryTree& tree, std::span<const LeafRange> leaves,
                   std::span<const PrimitiveRecord> primitives) {
    std::size_t before = bvh.leaves.size();
    bvh.leaves.resize(before + leaves.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.size(), 64),
                      [&](const auto& block) {
                          for (std::size_t i = block.begin(); i < block.end(); i++) {
                              std::span references(&tree.references[std::size_t(leaves[i].first)],
                                                   std::size_t(leaves[i].count));
                              bvh.leaves[before + i] = make_leaf(references, primitives);
                          }
                      });
}

} // namespace parhelion

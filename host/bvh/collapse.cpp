// Dynamic programming from the leaves up: the least cost of a subtree seen through 1 to 15 boxes.
#include "host/bvh/collapse.h"

#include "host/parallel.h"

#include <limits>

namespace parhelion {
namespace {

// Measured: a leaf of 16 triangles costs 0.7 of a node with 16 children.
constexpr float cost_of_node = 1.f, cost_of_leaf = 0.7f;
constexpr int task_references = 4096;

/// [roots]: least cost of a subtree represented by at most so many wide children, roots = 1 to 15.
using Costs = std::array<float, BVH_WIDTH>;

class Planner {
public:
    Planner(const BinaryTree& tree, CollapseChoice* choices) : tree_(tree), choices_(choices) {
        double area = half_area(tree.nodes[0].box);
        inverse_area_ = area > 0 ? 1 / area : 0; // where no box has any area all ways cost the same
    }

    Costs plan(int index) const {
        const BinaryNode& node = tree_.nodes[index];
        CollapseChoice& choice = choices_[index];
        choice.left_roots.fill(0);
        float probability = float(half_area(node.box) * inverse_area_);
        Costs costs;
        costs.fill(probability * cost_of_leaf);
        if (node.children < 0) return costs;
        Costs left, right;
        plan_children(node, left, right);
        Division inside = best_division(left, right, BVH_WIDTH);
        choice.left_roots[BVH_WIDTH] = inside.left_roots;
        float node_cost = probability * cost_of_node + inside.cost;
        if (!node.fits_leaf() || node_cost < costs[1]) {
            costs[1] = node_cost;
            choice.left_roots[1] = 1;
        }
        for (int roots = 2; roots < BVH_WIDTH; roots++) {
            Division apart = best_division(left, right, roots);
            bool better = apart.cost < costs[roots - 1];
            costs[roots] = better ? apart.cost : costs[roots - 1];
            choice.left_roots[roots] = better ? apart.left_roots : std::uint8_t{0};
        }
        return costs;
    }

private:
    struct Division {
        std::uint8_t left_roots;
        float cost;
    };

    static Division best_division(const Costs& left, const Costs& right, int roots) {
        Division best{1, left[1] + right[roots - 1]};
        for (int k = 2; k < roots; k++) {
            float cost = left[k] + right[roots - k];
            if (cost < best.cost) best = {std::uint8_t(k), cost};
        }
        return best;
    }

    void plan_children(const BinaryNode& node, Costs& left, Costs& right) const {
        if (node.count > task_references) {
            TaskGroup group;
            group.run([&] { left = plan(node.children); });
            right = plan(node.children + 1);
            group.wait();
        } else {
            left = plan(node.children);
            right = plan(node.children + 1);
        }
    }

    const BinaryTree& tree_;
    CollapseChoice* choices_;
    double inverse_area_;
};

} // namespace

CollapsePlan plan_collapse(const BinaryTree& tree) {
    CollapsePlan plan{LargeVector<CollapseChoice>(tree.nodes.size()), 0};
    plan.sah_cost = Planner(tree, plan.choices.data()).plan(0)[1];
    return plan;
}

} // namespace parhelion

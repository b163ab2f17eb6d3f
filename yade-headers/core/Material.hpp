// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Material is 80 bytes: id 32, label 40, density 72 (defaults -1, "", 1000). newAssocState and
// stateTypeOk stand before the index functions in the table. Lookups are exported. Verified: tests/abi.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>
#include <core/State.hpp>

namespace yade {

class Scene;

class Material : public Serializable, public Indexable {
public:
    Material() : id(-1), density(1000) {}
    virtual shared_ptr<State> newAssocState() const;
    virtual bool stateTypeOk(State*) const;

    static const shared_ptr<Material> byId(int id, Scene* scene = nullptr);
    static const shared_ptr<Material> byLabel(const string& label, Scene* scene = nullptr);

    int id;
    string label;
    Real density;

    YADE_ABI_STOCK_CLASS(Material)
    YADE_ABI_INDEX_FAMILY
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Material)

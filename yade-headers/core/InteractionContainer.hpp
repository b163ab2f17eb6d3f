// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: InteractionContainer is 192 bytes, its linear vector (real and potential interactions) at 24; find,
// insert, erase and requestErase are exported; Python does not know the class; an erased interaction stays as
// potential until the collider drops it. Verified: tests/abi.
#pragma once

#include <core/BodyContainer.hpp>
#include <core/Interaction.hpp>

namespace yade {

class InteractionContainer : public Serializable {
    using ContainerT = vector<shared_ptr<Interaction>>;
    ContainerT linIntrs;
    ContainerT sortedIntrs;
    const vector<shared_ptr<Body>>* bodies;
    size_t currSize;
    shared_ptr<Interaction> empty;
    ContainerT interaction;

public:
    bool dirty;
    std::mutex drawloopmutex;
    bool serializeSorted;
    long iterColliderLastRun;

    using iterator = ContainerT::iterator;
    using const_iterator = ContainerT::const_iterator;
    iterator begin() { return linIntrs.begin(); }
    iterator end() { return linIntrs.end(); }
    const_iterator begin() const { return linIntrs.begin(); }
    const_iterator end() const { return linIntrs.end(); }
    size_t size() { return currSize; }
    shared_ptr<Interaction>& operator[](size_t i) { return linIntrs[i]; }
    const shared_ptr<Interaction>& operator[](size_t i) const { return linIntrs[i]; }

    const shared_ptr<Interaction>& find(Body::id_t first, Body::id_t second);
    bool insert(const shared_ptr<Interaction>&);
    /// Takes an interaction out; the last one moves to its place. linPos is its linIx.
    bool erase(Body::id_t first, Body::id_t second, int linPos);
    void eraseNonReal();
    void requestErase(Body::id_t first, Body::id_t second);
    void requestErase(const shared_ptr<Interaction>&);
    void requestErase(Interaction*);

    InteractionContainer() = delete;
    YADE_ABI_STOCK_CLASS_WITHOUT_PYTHON(InteractionContainer)

    friend struct InteractionContainerLayout;
};

} // namespace yade

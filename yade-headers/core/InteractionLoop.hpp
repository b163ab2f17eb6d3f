// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: InteractionLoop is 216 bytes with these members; takes three lists of functors in its constructor,
// which Python finds as functors of the three dispatchers. Constructor and action are exported. Verified:
// tests/abi.
#pragma once

#include <core/GlobalEngine.hpp>

#include <list>
#include <utility>

namespace yade {

class IGeomDispatcher;
class IPhysDispatcher;
class LawDispatcher;
class IntrCallback;

class InteractionLoop : public GlobalEngine {
    bool alreadyWarnedNoCollider;
    vector<std::list<std::pair<int, int>>> eraseAfterLoopIds;

public:
    shared_ptr<IGeomDispatcher> geomDispatcher;
    shared_ptr<IPhysDispatcher> physDispatcher;
    shared_ptr<LawDispatcher> lawDispatcher;
    vector<shared_ptr<IntrCallback>> callbacks;
    bool loopOnSortedInteractions;

    InteractionLoop();
    void action() override;
    void pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict&) override;

    YADE_ABI_STOCK_CLASS(InteractionLoop)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(InteractionLoop)

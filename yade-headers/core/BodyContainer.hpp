// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: BodyContainer is 200 bytes, its vector of bodies (with empty pointers where one was erased) at 24;
// access functions are exported; iteration skips empty pointers. Verified: tests/abi.
#pragma once

#include <core/Body.hpp>

#include <boost/iterator/filter_iterator.hpp>
#include <mutex>

namespace yade {

class BodyContainer : public Serializable {
    using ContainerT = vector<shared_ptr<Body>>;

public:
    struct isNonEmptySharedPtr {
        bool operator()(const shared_ptr<Body>& body) const { return bool(body); }
    };
    using iterator = boost::filter_iterator<isNonEmptySharedPtr, ContainerT::iterator>;

    iterator begin();
    iterator end();
    size_t size() const;
    shared_ptr<Body>& operator[](unsigned int id);
    const shared_ptr<Body>& operator[](unsigned int id) const;
    bool exists(Body::id_t id) const;
    Body::id_t insert(shared_ptr<Body>);
    void updateRealBodies();

    ContainerT body;
    bool dirty;
    bool checkedByCollider;
    vector<Body::id_t> insertedBodies;
    vector<Body::id_t> erasedBodies;
    vector<Body::id_t> realBodies;
    bool useRedirection;
    bool enableRedirection;
    vector<Body::id_t> subdomainBodies;
    std::mutex drawloopmutex;

    BodyContainer() = delete;
    YADE_ABI_STOCK_CLASS(BodyContainer)
};

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: ForceContainer is 304 bytes and stands in Scene by value; adding goes to the calling thread's own
// vector without a lock, reading needs sync() first. Its functions are exported. Verified: tests/abi.
#pragma once

#include <core/Body.hpp>

#include <mutex>

namespace yade {

class ForceContainer {
    vector<vector<Vector3r>> _forceData;
    vector<vector<Vector3r>> _torqueData;
    vector<Body::id_t> _maxId;
    vector<size_t> sizeOfThreads;
    vector<Vector3r> _force;
    vector<Vector3r> _torque;
    vector<Vector3r> _permForce;
    vector<Vector3r> _permTorque;
    size_t size;
    bool syncedSizes;
    int nThreads;
    bool permForceUsed;
    bool permForceSynced;
    std::mutex globalMutex;
    const Vector3r _zero;

public:
    bool synced;
    unsigned long syncCount;
    long lastReset;

    ForceContainer();
    void addForce(Body::id_t id, const Vector3r& force);
    void addTorque(Body::id_t id, const Vector3r& torque);
    /// Straight into the sums: by one thread, while they are in sync, for an id that has room.
    void addForceUnsynced(Body::id_t id, const Vector3r& force);
    void addTorqueUnsynced(Body::id_t id, const Vector3r& torque);
    const Vector3r& getForce(Body::id_t id);
    const Vector3r& getTorque(Body::id_t id);
    const Vector3r& getForceUnsynced(Body::id_t id);
    const Vector3r& getTorqueUnsynced(Body::id_t id);
    void setPermForce(Body::id_t id, const Vector3r& force);
    void setPermTorque(Body::id_t id, const Vector3r& torque);
    const Vector3r& getPermForce(Body::id_t id);
    const Vector3r& getPermTorque(Body::id_t id);
    bool getPermForceUsed() const;
    void sync();
    void addMaxId(Body::id_t id);

    friend struct ForceContainerLayout;
};

} // namespace yade

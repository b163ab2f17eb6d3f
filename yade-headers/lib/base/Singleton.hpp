// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Omega, ClassFactory and Logging are reached through Singleton<T>::instance(), exported by libyade.
// Verified: weak symbols Singleton<yade::Omega>::instance() etc. in libyade.so. No body here: a second
// instance must never be made.
#pragma once

template <class T>
class Singleton {
public:
    static T& instance();
};

// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Logging lives in the global namespace; level of each named logger in a map at offset 8 (-1: follow
// "Default"); level numbers; colour functions are exported. Verified: tests/abi (yade.log.setLevel is seen
// here), symbols of libyade.so. Messages go to std::cerr and do not pass through Boost.Log, whose headers
// alone would take longer to compile than a law; yade.log.setOutputStream has therefore no effect on them.
#pragma once

#include <lib/base/Singleton.hpp>

#include <iostream>
#include <map>
#include <string>

class Logging : public Singleton<Logging> {
public:
    enum SeverityLevel {
        eNOFILTER = 0,
        eFATAL = 1,
        eERROR = 2,
        eWARN = 3,
        eINFO = 4,
        eDEBUG = 5,
        eTRACE = 6
    };

    Logging() = delete; // the library makes the only one
    std::string colorSeverity(SeverityLevel);
    std::string colorNameTag();
    std::string colorLineNumber();
    std::string colorFunction();
    std::string colorEnd();

    short int defaultLogLevel;
    std::map<std::string, short int> classLogLevels;
};

namespace yade::abi {

/// One named source of messages, filtered by the level that the user sets with yade.log.
class Logger {
public:
    explicit Logger(const char* name) : name_(name) { Logging::instance().classLogLevels[name_] = -1; }

    bool accepts(Logging::SeverityLevel level) const {
        const auto& levels = Logging::instance().classLogLevels;
        const auto own = levels.find(name_);
        const int limit =
            own == levels.end() || own->second < 0 ? Logging::instance().defaultLogLevel : own->second;
        return level <= limit;
    }

    /// Opens a line in the form YADE uses: <LEVEL> name:line function:
    std::ostream& begin(Logging::SeverityLevel level, int line, const char* function) const {
        static const char* const names[] = {"NOFILTER", "FATAL ERROR", "ERROR", "WARNING",
                                            "INFO",     "DEBUG",       "TRACE"};
        Logging& log = Logging::instance();
        return std::cerr << "<" << log.colorSeverity(level) << names[level] << log.colorEnd() << "> "
                         << log.colorNameTag() << name_ << log.colorEnd() << ":" << log.colorLineNumber()
                         << line << log.colorFunction() << " " << function << log.colorEnd() << ": ";
    }

private:
    std::string name_;
};

} // namespace yade::abi

#define YADE_ABI_LOG(level, message)                                                                         \
    {                                                                                                        \
        if (logger.accepts(Logging::level))                                                                  \
            logger.begin(Logging::level, __LINE__, __PRETTY_FUNCTION__) << message << std::endl;             \
    }
#define LOG_TRACE(message) YADE_ABI_LOG(eTRACE, message)
#define LOG_DEBUG(message) YADE_ABI_LOG(eDEBUG, message)
#define LOG_INFO(message) YADE_ABI_LOG(eINFO, message)
#define LOG_WARN(message) YADE_ABI_LOG(eWARN, message)
#define LOG_ERROR(message) YADE_ABI_LOG(eERROR, message)
#define LOG_FATAL(message) YADE_ABI_LOG(eFATAL, message)
#define LOG_NOFILTER(message) YADE_ABI_LOG(eNOFILTER, message)

#define DECLARE_LOGGER                                                                                       \
public:                                                                                                      \
    static ::yade::abi::Logger logger
#define CREATE_LOGGER(classname) ::yade::abi::Logger classname::logger(#classname)
#define CREATE_CPP_LOCAL_LOGGER(filename)                                                                    \
    namespace {                                                                                              \
    ::yade::abi::Logger logger(filename);                                                                    \
    }

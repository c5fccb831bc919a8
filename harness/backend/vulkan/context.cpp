#include "harness/backend/vulkan/context.h"

#include "harness/base/cpu_info.h"
#include "harness/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

namespace crossray::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                              VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* log)
{
    std::string text = data->pMessage != nullptr ? data->pMessage : "(a message without text)";
    std::replace(text.begin(), text.end(), '\n', ' ');
    static_cast<MessageLog*>(log)->add(std::move(text));
    return VK_FALSE;
}

// Both Vulkan idioms of "how many, then which".
template <typename T, typename List>
std::vector<T> enumerate(List list)
{
    uint32_t count = 0;
    list(&count, nullptr);
    std::vector<T> items(count);
    list(&count, items.data());
    items.resize(count);
    return items;
}

bool hasValidationLayer()
{
    const auto layers = enumerate<VkLayerProperties>(
        [](uint32_t* n, VkLayerProperties* p) { vkEnumerateInstanceLayerProperties(n, p); });
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
    });
}

std::optional<uint32_t> findComputeFamily(VkPhysicalDevice device, uint32_t& timestampBits)
{
    const auto families = enumerate<VkQueueFamilyProperties>(
        [&](uint32_t* n, VkQueueFamilyProperties* p) { vkGetPhysicalDeviceQueueFamilyProperties(device, n, p); });
    for (uint32_t i = 0; i < families.size(); ++i) {
        if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)) continue;
        timestampBits = families[i].timestampValidBits;
        return i;
    }
    return std::nullopt;
}

bool hasExtension(VkPhysicalDevice device, const char* name)
{
    const auto extensions = enumerate<VkExtensionProperties>(
        [&](uint32_t* n, VkExtensionProperties* p) { vkEnumerateDeviceExtensionProperties(device, nullptr, n, p); });
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

std::string formatVersion(uint32_t version)
{
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string describeDriver(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties)
{
    if (hasExtension(device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) {
        VkPhysicalDeviceDriverProperties driver{};
        driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
        VkPhysicalDeviceProperties2 query{};
        query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        query.pNext = &driver;
        vkGetPhysicalDeviceProperties2(device, &query);
        if (driver.driverInfo[0] != '\0') return fmt::format("{} {}", driver.driverName, driver.driverInfo);
        return fmt::format("{} {}", driver.driverName, formatVersion(properties.driverVersion));
    }
    return "version " + formatVersion(properties.driverVersion);
}

} // namespace

void MessageLog::add(std::string text)
{
    const std::lock_guard lock(mutex_);
    if (messages_.size() < kMostMessages)
        messages_.push_back(std::move(text));
    else
        ++dropped_;
}

std::vector<std::string> MessageLog::take()
{
    const std::lock_guard lock(mutex_);
    if (dropped_ > 0) messages_.push_back(fmt::format("and {} more messages", std::exchange(dropped_, 0)));
    return std::exchange(messages_, {});
}

Context::Context(const std::string& deviceName, bool validation)
{
    try {
        createInstance(validation);
        if (validation) createMessenger();
        choosePhysicalDevice(deviceName);
        createDevice();
    } catch (...) {
        destroy(); // the destructor does not run for a constructor that throws
        throw;
    }
}

Context::~Context()
{
    destroy();
}

void Context::destroy()
{
    if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
    if (messenger_ != VK_NULL_HANDLE) {
        const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroyMessenger(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

void Context::createInstance(bool validation)
{
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "crossray";
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;

    // Synchronization validation sees a missing barrier, which software devices would never show.
    const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &enabled;
    const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    if (validation) {
        if (!hasValidationLayer())
            throw EnvironmentError(fmt::format(
                "validation needs {}, which is not installed (Debian: vulkan-validationlayers)", kValidationLayer));
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
        info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
        info.ppEnabledExtensionNames = extensions.data();
    }
    check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
}

void Context::createMessenger()
{
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Without the general type: those come from the loader and are about other drivers of the machine.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = collectMessage;
    info.pUserData = &messages_;
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    if (create == nullptr)
        throw EnvironmentError("validation needs VK_EXT_debug_utils, which the layer does not offer");
    check(create(instance_, &info, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void Context::choosePhysicalDevice(const std::string& deviceName)
{
    const auto devices = enumerate<VkPhysicalDevice>(
        [&](uint32_t* n, VkPhysicalDevice* p) { return vkEnumeratePhysicalDevices(instance_, n, p); });
    std::vector<std::string> found;
    for (const VkPhysicalDevice device : devices) {
        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(device, &properties);
        const std::string name = properties.deviceName;
        const auto family = findComputeFamily(device, timestampBits_);
        if (properties.apiVersion < VK_API_VERSION_1_1 || !family) {
            found.push_back(fmt::format("\"{}\" (no Vulkan 1.1 compute)", name));
            continue;
        }
        if (name.find(deviceName) != std::string::npos) {
            physicalDevice_ = device;
            queueFamily_ = *family;
            return;
        }
        found.push_back(fmt::format("\"{}\"", name));
    }
    throw EnvironmentError(fmt::format("no Vulkan device is named \"{}\"; found: {}", deviceName,
                                       found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", "))));
}

void Context::createDevice()
{
    VkPhysicalDeviceMaintenance3Properties maintenance{};
    maintenance.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    VkPhysicalDeviceProperties2 query{};
    query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    query.pNext = &maintenance;
    vkGetPhysicalDeviceProperties2(physicalDevice_, &query);
    properties_ = query.properties;
    maxAllocation_ = maintenance.maxMemoryAllocationSize;
    vkGetPhysicalDeviceMemoryProperties(physicalDevice_, &memory_);
    driver_ = describeDriver(physicalDevice_, properties_);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queueFamily_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    // The buffers of a job share one allocation: a shader that writes past the end of one must not reach the next.
    VkPhysicalDeviceFeatures features{};
    features.robustBufferAccess = VK_TRUE;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &features;
    check(vkCreateDevice(physicalDevice_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
}

double Context::millisecondsBetween(uint64_t begin, uint64_t end) const
{
    const uint64_t mask = timestampBits_ >= 64 ? ~uint64_t{0} : (uint64_t{1} << timestampBits_) - 1;
    return static_cast<double>((end - begin) & mask) * static_cast<double>(properties_.limits.timestampPeriod) * 1e-6;
}

void Context::requireSampling(VkFormat format, ImageFilter filter) const
{
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(physicalDevice_, format, &properties);
    VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
    if (filter == ImageFilter::kLinear) needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if ((properties.optimalTilingFeatures & needed) == needed) return;
    throw EnvironmentError(fmt::format("{} cannot sample {} with a {} filter", properties_.deviceName,
                                       format == VK_FORMAT_R32_SFLOAT ? "R32F" : "RGBA32F",
                                       filter == ImageFilter::kLinear ? "linear" : "nearest"));
}

uint32_t Context::chooseMemoryType(uint32_t allowed, MemoryUse use) const
{
    constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const VkMemoryPropertyFlags required = use == MemoryUse::kDevice ? 0 : kHost;
    std::optional<uint32_t> best;
    int bestScore = -1;
    for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory_.memoryTypes[i].propertyFlags;
        if (!(allowed & (1u << i)) || (flags & required) != required) continue;
        const bool local = (flags & kLocal) != 0;
        const bool cached = (flags & kCached) != 0;
        int score = 0;
        // Memory that is fast for both sides is only found where they share it.
        if (use == MemoryUse::kDevice) score = 2 * local + ((flags & kHost) == kHost && cached ? 1 : 0);
        // The window that a discrete GPU opens on its memory is small: leave it to others.
        if (use == MemoryUse::kUpload) score = local ? 0 : 1;
        // Reading uncached memory is slower by two orders of magnitude.
        if (use == MemoryUse::kReadback) score = 2 * cached + !local;
        if (score > bestScore) {
            best = i;
            bestScore = score;
        }
    }
    if (!best)
        throw EnvironmentError(fmt::format("{} offers no memory that fits a buffer or image", properties_.deviceName));
    return *best;
}

VkMemoryPropertyFlags Context::memoryTypeFlags(uint32_t index) const
{
    return memory_.memoryTypes[index].propertyFlags;
}

Fingerprint Context::describe(const std::string& backendName) const
{
    Fingerprint result;
    result.backend = backendName;
    result.api = "Vulkan " + formatVersion(properties_.apiVersion);
    result.device = properties_.deviceName;
    result.driver = driver_;
    result.llvm = parseLlvmVersion(result.device);
    result.cpu = readCpuInfo();
    return result;
}

std::string parseLlvmVersion(const std::string& text)
{
    const std::string key = "LLVM ";
    const size_t begin = text.find(key);
    if (begin == std::string::npos) return {};
    const size_t end = text.find_first_not_of("0123456789.", begin + key.size());
    return text.substr(begin + key.size(), end == std::string::npos ? end : end - begin - key.size());
}

} // namespace crossray::vulkan

// Compiles a pair of shaders with the first Vulkan driver, draws nothing, and prints what the driver says of the fragment
// shader: a line "STATISTIC<tab>VALUE" for each number, then its texts, each after a line "=== NAME".
// Usage: compile_for_gpu vertex.spv fragment.spv
// The fragment shader's samplers are the first bindings; its uniforms are push constants.
#include <stdio.h>
#include <stdlib.h>
#include <vulkan/vulkan.h>

enum { SAMPLERS = 4, UNIFORM_BYTES = 128 };

static void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        fprintf(stderr, "%s: VkResult %d\n", call, result);
        exit(1);
    }
}
#define CHECK(call) check(call, #call)
#define TYPED(type, ...) {VK_STRUCTURE_TYPE_##type, __VA_ARGS__}

static VkPipelineShaderStageCreateInfo stage(VkDevice device, VkShaderStageFlagBits which, const char* path) {
    static uint32_t code[1 << 18];
    FILE* file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(1);
    }
    size_t bytes = fread(code, 1, sizeof code, file);
    fclose(file);
    VkShaderModuleCreateInfo info = TYPED(SHADER_MODULE_CREATE_INFO, .codeSize = bytes, .pCode = code);
    VkPipelineShaderStageCreateInfo made = TYPED(PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = which, .pName = "main");
    CHECK(vkCreateShaderModule(device, &info, NULL, &made.module));
    return made;
}

static VkDevice device_of_first_driver(void) {
    VkApplicationInfo application = TYPED(APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3);
    VkInstanceCreateInfo info = TYPED(INSTANCE_CREATE_INFO, .pApplicationInfo = &application);
    VkInstance instance;
    CHECK(vkCreateInstance(&info, NULL, &instance));
    uint32_t count = 1;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    vkEnumeratePhysicalDevices(instance, &count, &physical);  // VK_INCOMPLETE where there are more
    if (!physical) {
        fprintf(stderr, "the driver has no device\n");
        exit(1);
    }
    VkPhysicalDeviceDriverProperties driver = TYPED(PHYSICAL_DEVICE_DRIVER_PROPERTIES, NULL);
    VkPhysicalDeviceProperties2 properties = TYPED(PHYSICAL_DEVICE_PROPERTIES_2, &driver);
    vkGetPhysicalDeviceProperties2(physical, &properties);
    printf("=== driver\n%s, %s\n", properties.properties.deviceName, driver.driverInfo);

    float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = TYPED(DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority);
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executable =
        TYPED(PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR, .pipelineExecutableInfo = VK_TRUE);
    VkPhysicalDeviceDynamicRenderingFeatures dynamic =
        TYPED(PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES, &executable, VK_TRUE);
    const char* extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    VkDeviceCreateInfo wanted = TYPED(DEVICE_CREATE_INFO, &dynamic, .queueCreateInfoCount = 1,
                                      .pQueueCreateInfos = &queue, .enabledExtensionCount = 1,
                                      .ppEnabledExtensionNames = &extension);
    VkDevice device;
    CHECK(vkCreateDevice(physical, &wanted, NULL, &device));
    return device;
}

static VkPipelineLayout layout_of_bindings(VkDevice device) {
    VkDescriptorSetLayoutBinding bindings[SAMPLERS];
    for (uint32_t i = 0; i < SAMPLERS; i++)
        bindings[i] = (VkDescriptorSetLayoutBinding){i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                                     VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    VkDescriptorSetLayoutCreateInfo info =
        TYPED(DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = SAMPLERS, .pBindings = bindings);
    VkDescriptorSetLayout set;
    CHECK(vkCreateDescriptorSetLayout(device, &info, NULL, &set));
    VkPushConstantRange uniforms = {VK_SHADER_STAGE_FRAGMENT_BIT, 0, UNIFORM_BYTES};
    VkPipelineLayoutCreateInfo wanted = TYPED(PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &set,
                                              .pushConstantRangeCount = 1, .pPushConstantRanges = &uniforms);
    VkPipelineLayout layout;
    CHECK(vkCreatePipelineLayout(device, &wanted, NULL, &layout));
    return layout;
}

static VkPipeline pipeline_of(VkDevice device, const char* vertex, const char* fragment) {
    VkPipelineShaderStageCreateInfo stages[] = {stage(device, VK_SHADER_STAGE_VERTEX_BIT, vertex),
                                                stage(device, VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
    VkPipelineVertexInputStateCreateInfo input = TYPED(PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO, NULL);
    VkPipelineInputAssemblyStateCreateInfo assembly =
        TYPED(PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST);
    VkViewport viewport = {0, 0, 1024, 1024, 0, 1};
    VkRect2D scissor = {{0, 0}, {1024, 1024}};
    VkPipelineViewportStateCreateInfo view = TYPED(PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1,
                                                   .pViewports = &viewport, .scissorCount = 1, .pScissors = &scissor);
    VkPipelineRasterizationStateCreateInfo raster = TYPED(PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1.0f);
    VkPipelineMultisampleStateCreateInfo samples =
        TYPED(PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT);
    VkPipelineColorBlendAttachmentState attachment = {.colorWriteMask = 0xf};
    VkPipelineColorBlendStateCreateInfo blend =
        TYPED(PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1, .pAttachments = &attachment);
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    VkPipelineRenderingCreateInfo rendering =
        TYPED(PIPELINE_RENDERING_CREATE_INFO, .colorAttachmentCount = 1, .pColorAttachmentFormats = &format);
    VkGraphicsPipelineCreateInfo info =
        TYPED(GRAPHICS_PIPELINE_CREATE_INFO, &rendering,
              VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR | VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR,
              .stageCount = 2, .pStages = stages, .pVertexInputState = &input, .pInputAssemblyState = &assembly,
              .pViewportState = &view, .pRasterizationState = &raster, .pMultisampleState = &samples,
              .pColorBlendState = &blend, .layout = layout_of_bindings(device));
    VkPipeline pipeline;
    CHECK(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    return pipeline;
}

#define LOADED(name) ((PFN_##name)vkGetDeviceProcAddr(device, #name))

static void print_statistics(VkDevice device, const VkPipelineExecutableInfoKHR* which) {
    VkPipelineExecutableStatisticKHR found[64];
    uint32_t count = 64;
    for (uint32_t i = 0; i < count; i++)
        found[i] = (VkPipelineExecutableStatisticKHR)TYPED(PIPELINE_EXECUTABLE_STATISTIC_KHR, NULL);
    CHECK(LOADED(vkGetPipelineExecutableStatisticsKHR)(device, which, &count, found));
    for (uint32_t i = 0; i < count; i++)
        if (found[i].format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR)
            printf("%s\t%llu\n", found[i].name, (unsigned long long)found[i].value.u64);
}

static void print_texts(VkDevice device, const VkPipelineExecutableInfoKHR* which) {
    VkPipelineExecutableInternalRepresentationKHR found[16];
    uint32_t count = 16;
    for (uint32_t i = 0; i < count; i++)
        found[i] = (VkPipelineExecutableInternalRepresentationKHR)TYPED(PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR, NULL);
    CHECK(LOADED(vkGetPipelineExecutableInternalRepresentationsKHR)(device, which, &count, found));
    for (uint32_t i = 0; i < count; i++) found[i].pData = malloc(found[i].dataSize);
    CHECK(LOADED(vkGetPipelineExecutableInternalRepresentationsKHR)(device, which, &count, found));
    for (uint32_t i = 0; i < count; i++)
        printf("=== %s\n%.*s\n", found[i].name, (int)found[i].dataSize, (const char*)found[i].pData);
}

int main(int argc, char** argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: %s vertex.spv fragment.spv\n", argv[0]);
        return 2;
    }
    VkDevice device = device_of_first_driver();
    VkPipelineInfoKHR made = TYPED(PIPELINE_INFO_KHR, NULL, pipeline_of(device, argv[1], argv[2]));
    VkPipelineExecutablePropertiesKHR found[8];
    uint32_t count = 8;
    for (uint32_t i = 0; i < count; i++)
        found[i] = (VkPipelineExecutablePropertiesKHR)TYPED(PIPELINE_EXECUTABLE_PROPERTIES_KHR, NULL);
    CHECK(LOADED(vkGetPipelineExecutablePropertiesKHR)(device, &made, &count, found));
    for (uint32_t i = 0; i < count; i++) {
        if (!(found[i].stages & VK_SHADER_STAGE_FRAGMENT_BIT)) continue;
        VkPipelineExecutableInfoKHR which = TYPED(PIPELINE_EXECUTABLE_INFO_KHR, NULL, made.pipeline, i);
        printf("=== statistics\n");
        print_statistics(device, &which);
        print_texts(device, &which);
    }
    return 0;
}

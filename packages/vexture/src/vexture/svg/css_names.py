"""Names of CSS properties that browsers know and no drawing here shows, so that `@supports` answers as theirs does."""

from typing import Final

NAMES: Final = """
    accent-color align-content align-items align-self animation-composition animation-delay animation-direction
    animation-duration animation-fill-mode animation-iteration-count animation-play-state animation-range
    animation-timeline animation-timing-function appearance aspect-ratio backdrop-filter backface-visibility
    background-attachment background-blend-mode background-clip background-origin background-position
    background-repeat background-size block-size bottom box-decoration-break box-sizing break-after break-before
    break-inside caption-side caret-color clear clip color-scheme column-count column-fill column-gap column-rule
    column-span column-width columns contain contain-intrinsic-size container container-name container-type content
    content-visibility counter-increment counter-reset counter-set cursor direction empty-cells field-sizing flex
    flex-basis flex-direction flex-flow flex-grow flex-shrink flex-wrap float font-display font-optical-sizing
    font-palette gap grid grid-area grid-auto-columns grid-auto-flow grid-auto-rows grid-column grid-column-end
    grid-column-gap grid-column-start grid-gap grid-row grid-row-end grid-row-gap grid-row-start grid-template
    grid-template-areas grid-template-columns grid-template-rows hyphens image-orientation image-rendering inset
    inset-block inset-inline interpolate-size justify-content justify-items justify-self left line-break line-clamp
    line-height list-style list-style-image list-style-position list-style-type margin margin-block margin-bottom
    margin-inline margin-left margin-right margin-top mask-border mask-clip mask-composite mask-image mask-origin
    mask-position mask-repeat mask-size max-block-size max-height max-inline-size max-width min-block-size
    min-height min-inline-size min-width object-fit object-position offset offset-anchor offset-distance
    offset-position offset-rotate order orphans outline-color outline-offset outline-style outline-width
    overflow-anchor overflow-wrap overflow-x overflow-y overscroll-behavior padding-block padding-bottom
    padding-inline padding-left padding-right padding-top page perspective perspective-origin place-content
    place-items place-self pointer-events position print-color-adjust quotes resize right row-gap scroll-behavior
    scroll-margin scroll-padding scroll-snap-align scroll-snap-stop scroll-snap-type scroll-timeline scrollbar-color
    scrollbar-gutter scrollbar-width shape-image-threshold shape-margin shape-outside tab-size table-layout
    text-align text-align-last text-combine-upright text-decoration-skip-ink text-emphasis text-indent text-justify
    text-overflow text-size-adjust text-underline-position text-wrap top touch-action transform-style transition
    transition-behavior transition-delay transition-duration transition-property transition-timing-function
    user-select vertical-align view-timeline view-transition-name white-space-collapse widows will-change word-break
    word-wrap z-index zoom
"""

OTHER_PROPERTIES: Final = frozenset(NAMES.split())
"""As Chromium 150 knows them; what it calls otherwise than CSS does is not here."""


PREFIXED: Final = (
    *("align-", "appearance", "backface-visibility", "background-", "box-", "column", "flex", "justify-content"),
    *("line-clamp", "mask-", "order", "perspective", "print-color-adjust", "transform-style", "transition"),
    *("text-emphasis", "text-size-adjust", "user-select"),
)
"""How those begin that are known with the prefix ``-webkit-``, too."""


def is_other_property(name: str) -> bool:
    """Whether a property is one of these.

    Examples
    --------
    >>> is_other_property("backdrop-filter"), is_other_property("-webkit-user-select"), is_other_property("nothing")
    (True, True, False)
    """
    plain = name.removeprefix("-webkit-")
    return plain in OTHER_PROPERTIES and (plain == name or plain.startswith(PREFIXED))

(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* T, area: the convex hull of two rectangles is their bounding box less a triangle at each corner where each of the
   two owns one side; the union of the hulls of all possible pairs measures at most the sum of these areas. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Crossing Bounds.
From Dyadel Require Import Measure MeasureCut MeasureTriangle.
Import ListNotations.
Open Scope R_scope.

(* As dyd_irect_partial_edge_area2 computes it: twice the box, less the product of the legs at each corner. *)
Definition legs_ll (A B : rect) : R := Rmax 0 (- ((xlo B - xlo A) * (ylo B - ylo A))).
Definition legs_lr (A B : rect) : R := Rmax 0 ((xhi B - xhi A) * (ylo B - ylo A)).
Definition legs_ul (A B : rect) : R := Rmax 0 ((xlo B - xlo A) * (yhi B - yhi A)).
Definition legs_ur (A B : rect) : R := Rmax 0 (- ((xhi B - xhi A) * (yhi B - yhi A))).
Definition hull_area2 (A B : rect) : R :=
  2 * ((Rmax (xhi A) (xhi B) - Rmin (xlo A) (xlo B)) * (Rmax (yhi A) (yhi B) - Rmin (ylo A) (ylo B)))
  - legs_ll A B - legs_lr A B - legs_ul A B - legs_ur A B.
Definition hull_area (A B : rect) : R := hull_area2 A B / 2.

Lemma box_ordered a b c d : a <= b -> Rmin a c <= Rmax b d.
Proof. intros. pose proof (Rmin_l a c). pose proof (Rmax_l b d). lra. Qed.

Definition box (A B : rect) : rect :=
  Rect (Rmin (xlo A) (xlo B)) (Rmax (xhi A) (xhi B)) (Rmin (ylo A) (ylo B)) (Rmax (yhi A) (yhi B))
       (box_ordered _ _ _ _ (x_ordered A)) (box_ordered _ _ _ _ (y_ordered A)).

(* The corners cut off, where A owns the left or right side and B the lower or upper one. *)
Definition ul (A B : rect) (z : point) : Prop := xlo A < xlo B /\ yhi A < yhi B /\
  triangle (xlo A, yhi A) (xlo B, yhi B) (xlo A, yhi B) z.
Definition ur (A B : rect) (z : point) : Prop := xhi B < xhi A /\ yhi A < yhi B /\
  triangle (xhi A, yhi A) (xhi A, yhi B) (xhi B, yhi B) z.
Definition ll (A B : rect) (z : point) : Prop := xlo A < xlo B /\ ylo B < ylo A /\
  triangle (xlo A, ylo A) (xlo A, ylo B) (xlo B, ylo B) z.
Definition lr (A B : rect) (z : point) : Prop := xhi B < xhi A /\ ylo B < ylo A /\
  triangle (xhi A, ylo A) (xhi B, ylo B) (xhi A, ylo B) z.

(* For the two rectangles in either order. *)
Definition either (c : rect -> rect -> point -> Prop) (A B : rect) (z : point) : Prop := c A B z \/ c B A z.

(* ---- the areas cut off ---- *)

Lemma right_triangle (S : point -> Prop) a b c m : (forall z, triangle a b c z -> S z) -> orient a b c = m ->
  inner_ge S (m / 2).
Proof. intros H <-. now apply (inner_subset (triangle a b c) S _ _ H (Rle_refl _)), triangle_inner. Qed.

Lemma product_signs w h (P : Prop) : (0 < w -> 0 < h -> P) -> (w < 0 -> h < 0 -> P) -> (w * h <= 0 -> P) -> P.
Proof.
  intros F G H. destruct (Rle_dec (w * h) 0) as [N | N]; [now apply H |].
  apply Rnot_le_lt in N. destruct (Rtotal_order w 0) as [L | [-> | L]]; [apply G | lra | apply F]; nra.
Qed.

Ltac legs := intros; rewrite ?Rmax_right by nra; rewrite ?Rmax_left by nra; try (apply inner_trivial; lra).

Lemma ul_inner A B : inner_ge (either ul A B) (legs_ul A B / 2).
Proof.
  unfold legs_ul. apply (product_signs (xlo B - xlo A) (yhi B - yhi A)); legs.
  - eapply right_triangle; [intros z T; left; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
  - eapply right_triangle; [intros z T; right; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
Qed.

Lemma lr_inner A B : inner_ge (either lr A B) (legs_lr A B / 2).
Proof.
  unfold legs_lr. apply (product_signs (xhi B - xhi A) (ylo B - ylo A)); legs.
  - eapply right_triangle; [intros z T; right; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
  - eapply right_triangle; [intros z T; left; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
Qed.

Lemma ur_inner A B : inner_ge (either ur A B) (legs_ur A B / 2).
Proof.
  unfold legs_ur. apply (product_signs (xhi A - xhi B) (yhi B - yhi A)); legs.
  - eapply right_triangle; [intros z T; left; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
  - eapply right_triangle; [intros z T; right; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
Qed.

Lemma ll_inner A B : inner_ge (either ll A B) (legs_ll A B / 2).
Proof.
  unfold legs_ll. apply (product_signs (xlo B - xlo A) (ylo A - ylo B)); legs.
  - eapply right_triangle; [intros z T; left; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
  - eapply right_triangle; [intros z T; right; split; [lra | split; [lra | exact T]] | unfold orient; simpl; ring].
Qed.

(* ---- where they are ---- *)

Ltac bounds_of T := destruct (triangle_mean _ _ _ _ T) as [a [b [c [? [? [? [? [X Y]]]]]]]]; simpl in X, Y;
  rewrite X, Y; replace a with (1 - b - c) by lra; split; split; nra.

Lemma ul_bounds A B z : ul A B z -> xlo A < fst z < xlo B /\ yhi A < snd z < yhi B.
Proof. intros [G [H T]]. bounds_of T. Qed.
Lemma ur_bounds A B z : ur A B z -> xhi B < fst z < xhi A /\ yhi A < snd z < yhi B.
Proof. intros [G [H T]]. bounds_of T. Qed.
Lemma ll_bounds A B z : ll A B z -> xlo A < fst z < xlo B /\ ylo B < snd z < ylo A.
Proof. intros [G [H T]]. bounds_of T. Qed.
Lemma lr_bounds A B z : lr A B z -> xhi B < fst z < xhi A /\ ylo B < snd z < ylo A.
Proof. intros [G [H T]]. bounds_of T. Qed.

Ltac side := unfold orient; simpl; nra.

Lemma ul_lr A B z : ul A B z -> ~ lr B A z.
Proof.
  pose proof (x_ordered A). pose proof (y_ordered A). pose proof (x_ordered B). pose proof (y_ordered B).
  intros [G [L [O _]]] [G' [L' T]].
  assert (0 <= orient (xlo B, yhi B) (xlo A, yhi A) z) by (apply (triangle_side _ _ _ _ _ _ T); side).
  unfold orient in *. simpl in *. lra.
Qed.

Lemma ur_ll A B z : ur A B z -> ~ ll B A z.
Proof.
  pose proof (x_ordered A). pose proof (y_ordered A). pose proof (x_ordered B). pose proof (y_ordered B).
  intros [G [L [_ [_ O]]]] [G' [L' T]].
  assert (0 <= orient (xhi A, yhi A) (xhi B, yhi B) z) by (apply (triangle_side _ _ _ _ _ _ T); side).
  unfold orient in *. simpl in *. lra.
Qed.

Ltac facts A B := pose proof (x_ordered A); pose proof (y_ordered A); pose proof (x_ordered B); pose proof (y_ordered B).
Ltac all_bounds := repeat match goal with
  | H : either _ _ _ _ |- _ => destruct H
  | H : ul ?A ?B ?z |- _ => pose proof (ul_bounds A B z H); revert H
  | H : ur ?A ?B ?z |- _ => pose proof (ur_bounds A B z H); revert H
  | H : ll ?A ?B ?z |- _ => pose proof (ll_bounds A B z H); revert H
  | H : lr ?A ?B ?z |- _ => pose proof (lr_bounds A B z H); revert H end; intros.

Lemma corners_disjoint A B z :
  (either ul A B z -> ~ either ur A B z) /\ (either ul A B z -> ~ either ll A B z) /\
  (either ul A B z -> ~ either lr A B z) /\ (either ur A B z -> ~ either ll A B z) /\
  (either ur A B z -> ~ either lr A B z) /\ (either ll A B z -> ~ either lr A B z).
Proof.
  facts A B. repeat split; intros P Q; all_bounds; try lra;
    solve [eapply ul_lr; eassumption | eapply ur_ll; eassumption].
Qed.

Definition corners (A B : rect) (z : point) : Prop :=
  (either ul A B z \/ either ur A B z) \/ (either ll A B z \/ either lr A B z).

Lemma corners_inner A B :
  inner_ge (corners A B) (legs_ul A B / 2 + legs_ur A B / 2 + (legs_ll A B / 2 + legs_lr A B / 2)).
Proof.
  pose proof (corners_disjoint A B) as D. unfold corners.
  apply (inner_union (fun z => either ul A B z \/ either ur A B z) (fun z => either ll A B z \/ either lr A B z));
    try (intros z; specialize (D z); tauto).
  - apply (inner_union (either ul A B) (either ur A B)); try (intros z; specialize (D z); tauto);
      [apply ul_inner | apply ur_inner].
  - apply (inner_union (either ll A B) (either lr A B)); try (intros z; specialize (D z); tauto);
      [apply ll_inner | apply lr_inner].
Qed.

Lemma corners_in_box A B z : corners A B z -> inside z (box A B).
Proof.
  facts A B. pose proof (Rmin_l (xlo A) (xlo B)). pose proof (Rmin_r (xlo A) (xlo B)).
  pose proof (Rmax_l (xhi A) (xhi B)). pose proof (Rmax_r (xhi A) (xhi B)).
  pose proof (Rmin_l (ylo A) (ylo B)). pose proof (Rmin_r (ylo A) (ylo B)).
  pose proof (Rmax_l (yhi A) (yhi B)). pose proof (Rmax_r (yhi A) (yhi B)).
  intros [[P | P] | [P | P]]; all_bounds; unfold inside; simpl; lra.
Qed.

Lemma box_inside A B z : inside z A \/ inside z B -> inside z (box A B).
Proof.
  pose proof (Rmin_l (xlo A) (xlo B)). pose proof (Rmin_r (xlo A) (xlo B)).
  pose proof (Rmax_l (xhi A) (xhi B)). pose proof (Rmax_r (xhi A) (xhi B)).
  pose proof (Rmin_l (ylo A) (ylo B)). pose proof (Rmin_r (ylo A) (ylo B)).
  pose proof (Rmax_l (yhi A) (yhi B)). pose proof (Rmax_r (yhi A) (yhi B)).
  unfold inside. simpl. lra.
Qed.

Lemma orient_mix p q t x y : orient p q (mix t x y) = (1 - t) * orient p q x + t * orient p q y.
Proof. unfold orient, mix. simpl. ring. Qed.

(* The hull does not meet them. *)
Lemma hull_misses_corners A B z : partial_edge A B z -> ~ corners A B z.
Proof.
  facts A B. intros [x [y [X [Y [t [T ->]]]]]] C. unfold inside in X, Y.
  assert (M : forall p q, orient p q x <= 0 -> orient p q y <= 0 -> orient p q (mix t x y) <= 0).
  { intros p q U V. rewrite orient_mix. nra. }
  destruct C as [[[[G [L [O _]]] | [G [L [O _]]]] | [[G [L [_ [_ O]]]] | [G [L [_ [_ O]]]]]] |
    [[[G [L [_ [_ O]]]] | [G [L [_ [_ O]]]]] | [[G [L [O _]]] | [G [L [O _]]]]]];
    apply (Rlt_not_le _ _ O), M; side.
Qed.

Theorem hull_content A B : content_le (partial_edge A B) (hull_area A B).
Proof.
  apply (content_subset _ (fun z => inside z (box A B) /\ ~ corners A B z) (area (box A B)
    - (legs_ul A B / 2 + legs_ur A B / 2 + (legs_ll A B / 2 + legs_lr A B / 2)))).
  - intros z Z. split; [| now apply hull_misses_corners]. destruct Z as [x [y [X [Y [t [T ->]]]]]].
    apply inside_convex; [exact T | |]; apply box_inside; tauto.
  - unfold hull_area, hull_area2, area. simpl. lra.
  - apply content_rest; [apply corners_in_box | apply corners_inner].
Qed.

(* ---- the union ---- *)

Fixpoint hull_areas (B : sites) (pairs : list (nat * nat)) : R :=
  match pairs with [] => 0 | (i, j) :: rest => hull_area (B i) (B j) + hull_areas B rest end.

Lemma hulls_content B pairs :
  content_le (fun z => exists i j, In (i, j) pairs /\ partial_edge (B i) (B j) z) (hull_areas B pairs).
Proof.
  induction pairs as [| [i j] pairs IH].
  - apply (content_subset _ (fun _ => False) 0); [intros z [i [j [[] _]]] | simpl; lra | apply content_empty].
  - simpl. eapply content_subset; [| apply Rle_refl | apply (content_union _ _ _ _ (hull_content (B i) (B j)) IH)].
    intros z [k [l [[E | I] P]]]; [left | right]; [now inversion E; subst |]. now exists k, l.
Qed.

Lemma partial_edge_sym A B z : partial_edge A B z -> partial_edge B A z.
Proof.
  intros [x [y [X [Y [t [T ->]]]]]]. exists y, x. repeat split; try apply X; try apply Y.
  exists (1 - t). split; [lra |]. apply mix_swap.
Qed.

(* T, area: the union of the partial edges, which holds the true graph of every choice (graph_in_region), measures at
   most the sum of the areas of the hulls over a list of the possible pairs. *)
Theorem triangulation_area N B pairs :
  (forall i j, (i < N)%nat -> (j < N)%nat -> i <> j -> possible N B i j -> In (i, j) pairs \/ In (j, i) pairs) ->
  measure_le (possible_region N B) (hull_areas B pairs).
Proof.
  intros H. apply measure_of_content. eapply content_subset; [| apply Rle_refl | apply hulls_content].
  intros z [i [j [I [J [D [P Z]]]]]]. destruct (H i j I J D P) as [K | K].
  - now exists i, j.
  - exists j, i. split; [exact K | now apply partial_edge_sym].
Qed.

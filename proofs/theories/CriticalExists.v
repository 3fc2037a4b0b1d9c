(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A surely oriented triple has all six critical circles: walk along the curve of centres at equal distance from the
   two rectangles with the same letter; at one end the third rectangle is inside the circle, at the other outside. *)
From Coq Require Import Reals Lra Psatz Classical List.
From Dyadel Require Import Plane Distance Orientation Disc PartialDisc Curve.
Open Scope R_scope.

(* The orientation of a surely oriented triple is bounded away from 0. *)
Definition corners (B : rect) : list point := (xlo B, ylo B) :: (xlo B, yhi B) :: (xhi B, ylo B) :: (xhi B, yhi B) :: nil.

Lemma lowest_corner u B : In (lowest u B) (corners B).
Proof.
  unfold lowest, corners. destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); simpl; tauto.
Qed.

Lemma corners_inside B z : In z (corners B) -> inside z B.
Proof.
  pose proof (x_ordered B). pose proof (y_ordered B).
  intros [<- | [<- | [<- | [<- | []]]]]; unfold inside; simpl; repeat split; lra.
Qed.

Lemma list_margin {A} (f : A -> R) (l : list A) : (forall x, In x l -> 0 < f x) ->
  exists w, 0 < w /\ forall x, In x l -> w <= f x.
Proof.
  induction l as [| y l IH]; intros H.
  - exists 1. split; [lra | intros x []].
  - destruct IH as [w [W L]]; [intros x X; apply H; now right |].
    exists (Rmin w (f y)). pose proof (Rmin_l w (f y)). pose proof (Rmin_r w (f y)).
    split; [apply Rmin_pos; [exact W | apply H; now left] |].
    intros x [<- | X]; [lra |]. pose proof (L x X). lra.
Qed.

Lemma margin A B C : surely_left A B C ->
  exists w, 0 < w /\ forall a b c, inside a A -> inside b B -> inside c C -> w <= orient a b c.
Proof.
  intros S.
  destruct (list_margin (fun t => orient (fst t) (fst (snd t)) (snd (snd t)))
    (list_prod (corners A) (list_prod (corners B) (corners C)))) as [w [W L]].
  - intros [a [b c]] H. apply in_prod_iff in H as [Ha H]. apply in_prod_iff in H as [Hb Hc]. simpl.
    apply S; now apply corners_inside.
  - exists w. split; [exact W |]. intros a b c Ia Ib Ic.
    destruct (least_at_corner A b c a Ia) as [_ L1]. set (a' := lowest (snd b - snd c, fst c - fst b) A) in *.
    destruct (least_at_corner B c a' b Ib) as [_ L2]. set (b' := lowest (snd c - snd a', fst a' - fst c) B) in *.
    destruct (least_at_corner C a' b' c Ic) as [_ L3]. set (c' := lowest (snd a' - snd b', fst b' - fst a') C) in *.
    assert (Q : In (a', (b', c')) (list_prod (corners A) (list_prod (corners B) (corners C)))).
    { apply in_prod; [apply lowest_corner |]. apply in_prod; apply lowest_corner. }
    specialize (L _ Q). simpl in L.
    pose proof (orient_cycle a' b c). pose proof (orient_cycle b' c a'). pose proof (orient_cycle c' a' b'). lra.
Qed.

Lemma abs_product x y a b : Rabs x <= a -> Rabs y <= b -> Rabs (x * y) <= a * b.
Proof.
  intros X Y. rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; assumption.
Qed.

Lemma abs_between x a : - a <= x <= a -> Rabs x <= a.
Proof. intros. now apply Rabs_le. Qed.

Lemma between_abs x a : Rabs x <= a -> - a <= x <= a.
Proof. intros H. pose proof (Rle_abs x). pose proof (Rle_abs (- x)) as G. rewrite Rabs_Ropp in G. lra. Qed.

(* A bound for what in the power of a point does not depend on how far the centre is. *)
Lemma rest_bound M p q a b a' b' : Rabs p <= M -> Rabs q <= M -> Rabs a <= M -> Rabs b <= M -> Rabs a' <= M ->
  Rabs b' <= M ->
  Rabs ((a' - a) * (p * p + q * q - a * a - b * b) - (p - a) * (a' * a' - a * a + b' * b' - b * b)) <= 8 * (M * M * M).
Proof.
  intros P Q A B A' B'.
  assert (S : forall x, Rabs x <= M -> 0 <= x * x <= M * M).
  { intros x X. apply between_abs in X. nra. }
  pose proof (S p P). pose proof (S q Q). pose proof (S a A). pose proof (S b B). pose proof (S a' A'). pose proof (S b' B').
  apply between_abs in P, A, A'.
  assert (D1 : Rabs (a' - a) <= 2 * M) by (apply abs_between; lra).
  assert (D2 : Rabs (p - a) <= 2 * M) by (apply abs_between; lra).
  assert (E1 : Rabs (p * p + q * q - a * a - b * b) <= 2 * (M * M)) by (apply abs_between; lra).
  assert (E2 : Rabs (a' * a' - a * a + b' * b' - b * b) <= 2 * (M * M)) by (apply abs_between; lra).
  pose proof (abs_product _ _ _ _ D1 E1) as F1. pose proof (abs_product _ _ _ _ D2 E2) as F2.
  apply between_abs in F1, F2. apply abs_between. lra.
Qed.

Section Exists.
Variables (u v : point) (sigma : R) (fr : frame u v sigma).
Variables (l m : letter) (X Y Z : rect) (gap M w : R).
Variable gap_pos : 0 < gap.
Variable separated : forall a b, inside a Y -> inside b Z -> dot u a + gap <= dot u b.
Variable bounded : forall p, inside p X \/ inside p Y \/ inside p Z -> Rabs (dot u p) <= M /\ Rabs (dot v p) <= M.
Variable w_pos : 0 < w.
Variable turned : forall x y z, inside x X -> inside y Y -> inside z Z -> w <= orient y z x.

Let c (t : R) : point := at_ u v (curve u v sigma fr l Y Z gap gap_pos separated t) t.

(* The power of x, times a positive number, is a bounded term less 2 t times the orientation. *)
Lemma power_along t x : inside x X -> exists k r : R, 0 < k /\ Rabs r <= 8 * (M * M * M) /\
  exists o, w <= o /\ k * (dist2 (c t) x - reach l (c t) Y * reach l (c t) Y) = r - 2 * t * (sigma * o).
Proof.
  intros I. set (s := curve u v sigma fr l Y Z gap gap_pos separated t).
  set (y := touching l (c t) Y). set (z := touching l (c t) Z).
  pose proof (touching_inside l (c t) Y) as Iy. fold y in Iy. pose proof (touching_inside l (c t) Z) as Iz. fold z in Iz.
  assert (Ey : dist2 (c t) y = reach l (c t) Y * reach l (c t) Y) by (unfold y; rewrite <- touching_dist, dist_sq; reflexivity).
  assert (Ez : dist2 (c t) z = reach l (c t) Y * reach l (c t) Y).
  { pose proof (curve_equal u v sigma fr l Y Z gap gap_pos separated t) as E. fold (c t) in E. fold s in E.
    change (at_ u v s t) with (c t) in E. rewrite E. unfold z. rewrite <- touching_dist, dist_sq. reflexivity. }
  pose proof fr as [D [A [_ O]]]. pose proof (separated y z Iy Iz) as G.
  pose proof (turned x y z I Iy Iz) as W. specialize (O y z x).
  destruct (bounded x) as [Bx Bx']; [tauto |]. destruct (bounded y) as [By By']; [tauto |].
  destruct (bounded z) as [Bz Bz']; [tauto |].
  rewrite D in Ey, Ez. destruct (A s t) as [E1 E2]. change (at_ u v s t) with (c t) in E1, E2.
  rewrite E1, E2 in Ey, Ez. clear A.
  exists (dot u z - dot u y),
    ((dot u z - dot u y) * (dot u x * dot u x + dot v x * dot v x - dot u y * dot u y - dot v y * dot v y)
     - (dot u x - dot u y) * (dot u z * dot u z - dot u y * dot u y + dot v z * dot v z - dot v y * dot v y)).
  split; [lra |]. split; [now apply rest_bound |]. exists (orient y z x). split; [exact W |].
  rewrite <- O, <- Ey, D, E1, E2.
  assert (Eq : 2 * s * (dot u z - dot u y) = dot u z * dot u z - dot u y * dot u y + dot v z * dot v z - dot v y * dot v y
    - 2 * t * (dot v z - dot v y)) by lra.
  transitivity ((dot u z - dot u y) * (dot u x * dot u x + dot v x * dot v x - dot u y * dot u y - dot v y * dot v y)
    - (2 * s * (dot u z - dot u y)) * (dot u x - dot u y) - 2 * t * (dot v x - dot v y) * (dot u z - dot u y)); [ring |].
  rewrite Eq. ring.
Qed.

Let far : R := (4 * (M * M * M) + 1) / w.

Lemma far_enough o : w <= o -> 8 * (M * M * M) < 2 * far * o /\ 0 <= far.
Proof.
  intros H. assert (M0 : 0 <= M).
  { destruct (bounded (nearest (0, 0) X)) as [B _]; [left; apply nearest_inside |]. pose proof (Rabs_pos (dot u (nearest (0, 0) X))). lra. }
  assert (0 <= M * M * M) by (apply Rmult_le_pos; [apply Rmult_le_pos |]; exact M0).
  assert (Fw : far * w = 4 * (M * M * M) + 1) by (unfold far; field; lra).
  assert (F0 : 0 <= far) by (unfold far; apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat]).
  split; [| exact F0]. assert (far * w <= far * o) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma inside_end : reach m (c (sigma * far)) X <= reach l (c (sigma * far)) Y.
Proof.
  set (t := sigma * far). set (x := touching m (c t) X).
  destruct (power_along t x (touching_inside _ _ _)) as [k [r [K [Hr [o [Ho E]]]]]].
  destruct (far_enough o Ho) as [Fo _]. pose proof fr as [_ [_ [S _]]]. apply between_abs in Hr.
  assert (T : 2 * t * (sigma * o) = 2 * far * o).
  { unfold t. transitivity ((sigma * sigma) * (2 * far * o)); [ring | rewrite S; ring]. }
  rewrite T in E. rewrite <- (touching_dist m (c t) X). fold x.
  apply le_of_squares; [apply reach_nonneg |]. rewrite dist_sq.
  assert (dist2 (c t) x - reach l (c t) Y * reach l (c t) Y < 0) by (apply (Rmult_lt_reg_l k); lra). lra.
Qed.

Lemma outside_end : reach l (c (- sigma * far)) Y <= reach m (c (- sigma * far)) X.
Proof.
  set (t := - sigma * far). set (x := touching m (c t) X).
  destruct (power_along t x (touching_inside _ _ _)) as [k [r [K [Hr [o [Ho E]]]]]].
  destruct (far_enough o Ho) as [Fo _]. pose proof fr as [_ [_ [S _]]]. apply between_abs in Hr.
  assert (T : 2 * t * (sigma * o) = - (2 * far * o)).
  { unfold t. transitivity (- ((sigma * sigma) * (2 * far * o))); [ring | rewrite S; ring]. }
  rewrite T in E. rewrite <- (touching_dist m (c t) X). fold x.
  apply le_of_squares; [apply dist_nonneg |]. rewrite dist_sq.
  assert (0 < dist2 (c t) x - reach l (c t) Y * reach l (c t) Y) by (apply (Rmult_lt_reg_l k); lra). lra.
Qed.

Lemma circle_on_curve : exists q r, touches m q r X /\ touches l q r Y /\ touches l q r Z.
Proof.
  set (time x := sigma * far * (1 - 2 * x)).
  set (cv := curve u v sigma fr l Y Z gap gap_pos separated).
  assert (Ct : continuity time) by (unfold time; reg).
  assert (Cc : continuity (fun x => cv (time x))).
  { apply (continuity_comp time cv); [exact Ct | apply curve_continuous]. }
  destruct (intermediate (fun x => reach m (c (time x)) X - reach l (c (time x)) Y)) as [x [_ E]].
  - apply (continuity_minus (fun x => reach m (c (time x)) X) (fun x => reach l (c (time x)) Y)).
    + exact (reach_continuous u v sigma fr m X (fun x => cv (time x)) time Cc Ct).
    + exact (reach_continuous u v sigma fr l Y (fun x => cv (time x)) time Cc Ct).
  - replace (time 0) with (sigma * far) by (unfold time; ring). pose proof inside_end. lra.
  - replace (time 1) with (- sigma * far) by (unfold time; ring). pose proof outside_end. lra.
  - exists (c (time x)), (reach l (c (time x)) Y). rewrite !touches_reach.
    split; [lra |]. split; [reflexivity |].
    symmetry. apply (curve_equal u v sigma fr l Y Z gap gap_pos separated).
Qed.
End Exists.

Lemma size_bound B p : inside p B -> Rabs (fst p) <= Rabs (xlo B) + Rabs (xhi B) + Rabs (ylo B) + Rabs (yhi B) /\
  Rabs (snd p) <= Rabs (xlo B) + Rabs (xhi B) + Rabs (ylo B) + Rabs (yhi B).
Proof.
  intros [Px Py]. pose proof (Rabs_pos (xlo B)). pose proof (Rabs_pos (xhi B)). pose proof (Rabs_pos (ylo B)).
  pose proof (Rabs_pos (yhi B)). pose proof (Rle_abs (xhi B)). pose proof (Rle_abs (yhi B)).
  pose proof (Rle_abs (- xlo B)) as A. pose proof (Rle_abs (- ylo B)) as C. rewrite Rabs_Ropp in A, C.
  split; apply abs_between; lra.
Qed.

Lemma frame_right : frame (1, 0) (0, 1) 1.
Proof. unfold frame, at_, dot, dist2, orient. simpl. repeat split; intros; ring. Qed.
Lemma frame_left : frame (-1, 0) (0, 1) (-1).
Proof. unfold frame, at_, dot, dist2, orient. simpl. repeat split; intros; ring. Qed.
Lemma frame_up : frame (0, 1) (1, 0) (-1).
Proof. unfold frame, at_, dot, dist2, orient. simpl. repeat split; intros; ring. Qed.
Lemma frame_down : frame (0, -1) (1, 0) 1.
Proof. unfold frame, at_, dot, dist2, orient. simpl. repeat split; intros; ring. Qed.

Lemma disjoint_gap Y Z : (forall p, inside p Y -> ~ inside p Z) ->
  xhi Y < xlo Z \/ xhi Z < xlo Y \/ yhi Y < ylo Z \/ yhi Z < ylo Y.
Proof.
  intros H. apply NNPP. intros N. pose proof (x_ordered Y). pose proof (x_ordered Z). pose proof (y_ordered Y).
  pose proof (y_ordered Z).
  apply (H (Rmax (xlo Y) (xlo Z), Rmax (ylo Y) (ylo Z))); unfold inside; simpl; unfold Rmax;
    destruct (Rle_dec (xlo Y) (xlo Z)); destruct (Rle_dec (ylo Y) (ylo Z)); repeat split; lra.
Qed.

(* One letter for X, one for both Y and Z. *)
Lemma circle_exists l m X Y Z : surely_left X Y Z -> exists q r, touches m q r X /\ touches l q r Y /\ touches l q r Z.
Proof.
  intros S. destruct (margin X Y Z S) as [w [W L]].
  assert (T : forall x y z, inside x X -> inside y Y -> inside z Z -> w <= orient y z x).
  { intros x y z Ix Iy Iz. rewrite <- orient_cycle. now apply L. }
  set (size B := Rabs (xlo B) + Rabs (xhi B) + Rabs (ylo B) + Rabs (yhi B)).
  assert (size_pos : forall B, 0 <= size B).
  { intros B. unfold size. pose proof (Rabs_pos (xlo B)). pose proof (Rabs_pos (xhi B)). pose proof (Rabs_pos (ylo B)).
    pose proof (Rabs_pos (yhi B)). lra. }
  set (M := size X + size Y + size Z).
  assert (Bd : forall p, inside p X \/ inside p Y \/ inside p Z -> Rabs (fst p) <= M /\ Rabs (snd p) <= M).
  { intros p H. pose proof (size_pos X). pose proof (size_pos Y). pose proof (size_pos Z). unfold M.
    destruct H as [H | [H | H]]; apply size_bound in H; unfold size in *; lra. }
  assert (Dj : forall p, inside p Y -> ~ inside p Z).
  { intros p Iy Iz. pose proof (S _ p p (nearest_inside (0, 0) X) Iy Iz) as Q. unfold orient in Q. lra. }
  assert (Neg : forall a, Rabs (-1 * a) = Rabs a) by (intros a; rewrite <- Rabs_Ropp; f_equal; ring).
  destruct (disjoint_gap Y Z Dj) as [G | [G | [G | G]]].
  - apply (circle_on_curve (1, 0) (0, 1) 1 frame_right l m X Y Z (xlo Z - xhi Y) M w); [lra | | | exact W | exact T].
    + intros a b [A _] [B _]. unfold dot. simpl. lra.
    + intros p H. destruct (Bd p H). unfold dot. simpl. rewrite !Rmult_0_l, !Rmult_1_l, Rplus_0_l, Rplus_0_r. now split.
  - apply (circle_on_curve (-1, 0) (0, 1) (-1) frame_left l m X Y Z (xlo Y - xhi Z) M w); [lra | | | exact W | exact T].
    + intros a b [A _] [B _]. unfold dot. simpl. lra.
    + intros p H. destruct (Bd p H). unfold dot. simpl. rewrite !Rmult_0_l, !Rmult_1_l, Rplus_0_l, Rplus_0_r, Neg. now split.
  - apply (circle_on_curve (0, 1) (1, 0) (-1) frame_up l m X Y Z (ylo Z - yhi Y) M w); [lra | | | exact W | exact T].
    + intros a b [_ A] [_ B]. unfold dot. simpl. lra.
    + intros p H. destruct (Bd p H). unfold dot. simpl. rewrite !Rmult_0_l, !Rmult_1_l, Rplus_0_l, Rplus_0_r. now split.
  - apply (circle_on_curve (0, -1) (1, 0) 1 frame_down l m X Y Z (ylo Y - yhi Z) M w); [lra | | | exact W | exact T].
    + intros a b [_ A] [_ B]. unfold dot. simpl. lra.
    + intros p H. destruct (Bd p H). unfold dot. simpl. rewrite !Rmult_0_l, !Rmult_1_l, Rplus_0_l, Rplus_0_r, Neg. now split.
Qed.

Lemma surely_left_cycle X Y Z : surely_left X Y Z -> surely_left Y Z X.
Proof. intros S y z x Iy Iz Ix. rewrite <- orient_cycle. now apply S. Qed.

(* Every surely oriented triple has a circle with any three letters. *)
Lemma critical_left l m n X Y Z : surely_left X Y Z -> exists q r, critical l m n X Y Z q r.
Proof.
  intros S. assert (E : m = n \/ n = l \/ l = m) by (destruct l, m, n; tauto).
  destruct E as [-> | [-> | ->]].
  - destruct (circle_exists n l X Y Z S) as [q [r [A [B C0]]]]. now exists q, r.
  - destruct (circle_exists l m Y Z X (surely_left_cycle _ _ _ S)) as [q [r [A [B C0]]]]. now exists q, r.
  - destruct (circle_exists m n Z X Y) as [q [r [A [B C0]]]]; [now do 2 apply surely_left_cycle |]. now exists q, r.
Qed.

Theorem critical_circle_exists l m n X Y Z : surely_oriented X Y Z -> exists q r, critical l m n X Y Z q r.
Proof.
  intros [S | S]; [now apply critical_left |]. apply surely_right_left in S.
  destruct (critical_left l n m X Z Y S) as [q [r H]]. exists q, r. now apply critical_swap.
Qed.

(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Convex patches of the plane of centres, with their directions, that hold no centre of a pair [PLANE-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve.
Open Scope R_scope.

(* A patch is what its corners and its directions span: the convex hull of the corners C plus the cone of the directions
   D; its directions are that cone. *)
Inductive cone (D : point -> Prop) : point -> Prop :=
| cone_of u : D u -> cone D u
| cone_sum u v s t : 0 <= s -> 0 <= t -> 0 < s + t -> cone D u -> cone D v ->
    cone D (s * fst u + t * fst v, s * snd u + t * snd v).
Inductive patch (C D : point -> Prop) : point -> Prop :=
| patch_corner c : C c -> patch C D c
| patch_mix a b t : 0 <= t <= 1 -> patch C D a -> patch C D b -> patch C D (mix t a b)
| patch_ray c u t : 0 <= t -> patch C D c -> cone D u -> patch C D (fst c + t * fst u, snd c + t * snd u).

(* X is nearer than Y at all corners, and farther out in all directions. *)
Definition beats (X Y : rect) (C D : point -> Prop) : Prop :=
  (forall c, C c -> dl c X < ds c Y) /\ (forall u, D u -> dot u (highest u Y) < dot u (lowest u X)).

Lemma beyond_all u X Y : dot u (highest u Y) < dot u (lowest u X) <->
  forall x y, inside x X -> inside y Y -> dot u y < dot u x.
Proof.
  destruct (highest_spec u Y) as [IY HY]. destruct (lowest_spec u X) as [IX LX]. split.
  - intros H x y Hx Hy. pose proof (HY y Hy). pose proof (LX x Hx). lra.
  - intros H. now apply H.
Qed.

Lemma beats_cone X Y C D u : beats X Y C D -> cone D u -> dot u (highest u Y) < dot u (lowest u X).
Proof.
  intros [_ H] U. induction U as [u U | u v s t S T P _ IU _ IV]; [now apply H |].
  rewrite beyond_all in *. intros x y Hx Hy. specialize (IU x y Hx Hy). specialize (IV x y Hx Hy).
  replace (dot (s * fst u + t * fst v, s * snd u + t * snd v) y) with (s * dot u y + t * dot v y)
    by (unfold dot; simpl; ring).
  replace (dot (s * fst u + t * fst v, s * snd u + t * snd v) x) with (s * dot u x + t * dot v x)
    by (unfold dot; simpl; ring).
  destruct (Rle_lt_or_eq_dec 0 s S) as [S1 | <-].
  - pose proof (Rmult_lt_compat_l s _ _ S1 IU). assert (t * dot v y <= t * dot v x) by (apply Rmult_le_compat_l; lra). lra.
  - assert (T1 : 0 < t) by lra. pose proof (Rmult_lt_compat_l t _ _ T1 IV). lra.
Qed.

(* So it is nearer in the whole patch. *)
Theorem beats_patch X Y C D c : beats X Y C D -> patch C D c -> dl c X < ds c Y.
Proof.
  intros H P. induction P as [c P | a b t T _ IA _ IB | c u t T _ IC U]; [now apply (proj1 H) | |].
  - now apply closer_rect_convex.
  - apply closer_rect_ray; [exact T | exact IC |]. intros x y Hx Hy.
    pose proof (beats_cone X Y C D u H U) as E. rewrite beyond_all in E. specialize (E x y Hx Hy). lra.
Qed.

(* One of the others, or of the pair, dominates i in the patch, or dominates j there. *)
Definition decided (N : nat) (B : sites) (i j : nat) (C D : point -> Prop) : Prop :=
  exists k, (k < N)%nat /\ (beats (B k) (B i) C D \/ beats (B k) (B j) C D).

(* In a decided patch no centre is possibly nearest to both, nor is a direction a centre at infinity. *)
Theorem decided_patch N B i j C D : (i < N)%nat -> (j < N)%nat -> decided N B i j C D ->
  (forall c, patch C D c -> ~ possible_at N B (pair i j) c) /\
  (forall u, cone D u -> ~ (forall k, (k < N)%nat -> dot u (lowest u (B k)) <= dot u (highest u (B i)) /\
    dot u (lowest u (B k)) <= dot u (highest u (B j)))).
Proof.
  intros I J [k [K H]]. split.
  - intros c P Q. destruct H as [H | H]; pose proof (beats_patch _ _ _ _ c H P).
    + pose proof (Q i I (or_introl eq_refl) k K). lra.
    + pose proof (Q j J (or_intror eq_refl) k K). lra.
  - intros u P Q. destruct (Q k K). destruct H as [H | H]; pose proof (beats_cone _ _ _ _ u H P); lra.
Qed.

(* Decided patches that cover the plane with its directions: the pair is impossible. *)
Theorem patches_decide N B i j (P : (point -> Prop) -> (point -> Prop) -> Prop) : (i < N)%nat -> (j < N)%nat ->
  (forall c, exists C D, P C D /\ patch C D c) -> (forall u, u <> (0, 0) -> exists C D, P C D /\ cone D u) ->
  (forall C D, P C D -> decided N B i j C D) -> ~ possible N B i j.
Proof.
  intros I J Plane Far All [E | [u [U H]]].
  - apply (pair_possible N B i j I J) in E. destruct E as [c E]. destruct (Plane c) as [C [D [Q R]]].
    now apply (proj1 (decided_patch N B i j C D I J (All C D Q)) c R).
  - destruct (Far u U) as [C [D [Q R]]]. apply (proj2 (decided_patch N B i j C D I J (All C D Q)) u R).
    intros k K. split; apply H; try assumption; [now left | now right].
Qed.

(* One centre, or one direction, shows that a pair is possible. *)
Theorem centre_shows N B i j c : (forall k, (k < N)%nat -> ds c (B i) <= dl c (B k) /\ ds c (B j) <= dl c (B k)) ->
  possible N B i j.
Proof. intros H. left. exists c. intros k K _ _. now apply H. Qed.

Theorem direction_shows N B i j u : u <> (0, 0) ->
  (forall k, (k < N)%nat -> dot u (lowest u (B k)) <= dot u (highest u (B i)) /\
    dot u (lowest u (B k)) <= dot u (highest u (B j))) -> possible N B i j.
Proof. intros U H. right. exists u. split; [exact U |]. intros m k _ [-> | ->] K; now apply H. Qed.

(* Rivals: a site with the least dl somewhere within d of c has at c at most the least dl plus 2 d. *)
Theorem rival_near N B c x d m k : (k < N)%nat -> dist c x <= d ->
  (forall l, (l < N)%nat -> dl x (B m) <= dl x (B l)) -> dl c (B m) <= dl c (B k) + 2 * d.
Proof.
  intros K X L. pose proof (L k K). pose proof (dl_move c x (B m)). pose proof (dl_move x c (B k)).
  rewrite (dist_sym x c) in *. lra.
Qed.

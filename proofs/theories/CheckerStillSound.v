(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the outcome "fixpoint" says, where the checker proves it: narrower rectangles, in which the sites that stay are as
   they were, change nothing. B before, B' now. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Narrowed Checker CheckerSound CheckerFaces CheckerComplete.
From Dyadel Require Import CheckerBounds CheckerBoundsSound CheckerTies CheckerTiesSound CheckerOutcomeSound CheckerStill.
Import ListNotations.
Open Scope R_scope.

(* ---- rectangles that stay ---- *)

Lemma rect_same (A A' : rect) : refines A' A -> refines A A' -> A' = A.
Proof.
  intros H G.
  assert (L : inside (xlo A, ylo A) A) by (pose proof (x_ordered A); pose proof (y_ordered A); split; simpl; lra).
  assert (U : inside (xhi A, yhi A) A) by (pose proof (x_ordered A); pose proof (y_ordered A); split; simpl; lra).
  assert (L' : inside (xlo A', ylo A') A') by (pose proof (x_ordered A'); pose proof (y_ordered A'); split; simpl; lra).
  assert (U' : inside (xhi A', yhi A') A') by (pose proof (x_ordered A'); pose proof (y_ordered A'); split; simpl; lra).
  apply G in L, U. apply H in L', U'. destruct L as [Lx Ly], U as [Ux Uy], L' as [Lx' Ly'], U' as [Ux' Uy']. simpl in *.
  destruct A as [a b c d X Y], A' as [a' b' c' d' X' Y']. simpl in *.
  assert (a' = a) by lra. assert (b' = b) by lra. assert (c' = c) by lra. assert (d' = d) by lra. subst.
  f_equal; apply proof_irrelevance.
Qed.

Lemma point_same (A A' : rect) : xlo A = xhi A -> ylo A = yhi A -> refines A' A -> A' = A.
Proof.
  intros X Y H. apply rect_same; [exact H |]. intros z [Zx Zy]. destruct (H _ (nearest_inside z A')) as [Nx Ny].
  replace z with (nearest z A'); [apply nearest_inside |].
  destruct z as [u v]. destruct (nearest (u, v) A') as [u' v']. simpl in *. f_equal; lra.
Qed.

(* ---- maps ---- *)

Lemma find_add_same {A : Type} (m : Map.t A) k x : Map.find k (Map.add k x m) = Some x.
Proof. apply Map.find_1, Map.add_1. reflexivity. Qed.

Lemma find_add_other {A : Type} (m : Map.t A) k i x : k <> i -> Map.find i (Map.add k x m) = Map.find i m.
Proof.
  intros D. destruct (Map.find i m) as [y |] eqn:F.
  - apply Map.find_1, Map.add_2; [exact D |]. now apply Map.find_2.
  - destruct (Map.find i (Map.add k x m)) as [y |] eqn:G; [| reflexivity].
    apply Map.find_2, Map.add_3, Map.find_1 in G; [congruence | exact D].
Qed.

Lemma is_in_index {A : Type} (key : A -> Z) l x : In x l -> is_in (index key l) (key x) = true.
Proof.
  unfold index. assert (G : forall m, In x l \/ is_in m (key x) = true -> is_in (add_all key l m) (key x) = true);
    [| intros I; apply G; now left].
  induction l as [| t l IH]; intros m [I | I]; simpl in *; [destruct I | exact I | |].
  - apply IH. destruct I as [-> | I]; [right; unfold is_in; now rewrite find_add_same | now left].
  - apply IH. right. unfold is_in in *. destruct (Z.eq_dec (key t) (key x)) as [Q | Q].
    + rewrite Q. now rewrite find_add_same.
    + now rewrite find_add_other.
Qed.

Section Partners.
Variable moves : Map.t box.

Lemma add_partner_keeps m a b i k : In k (partners m i) -> In k (partners (add_partner moves m a b) i).
Proof.
  intros H. unfold add_partner. destruct (is_in moves b); [| exact H]. unfold partners at 1.
  destruct (Z.eq_dec a i) as [-> | D]; [rewrite find_add_same; now right | now rewrite find_add_other].
Qed.

Lemma add_partner_adds m i k : is_in moves k = true -> In k (partners (add_partner moves m i k) i).
Proof. intros H. unfold add_partner. rewrite H. unfold partners at 1. rewrite find_add_same. now left. Qed.

Lemma partners_found listed e i k : In e listed -> is_in moves k = true ->
  (from e = i /\ to e = k) \/ (from e = k /\ to e = i) -> In k (partners (movable_partners moves listed) i).
Proof.
  intros I H Q. unfold movable_partners.
  assert (G : forall m, In e listed \/ In k (partners m i) -> In k (partners (fold_left (fun m e =>
    add_partner moves (add_partner moves m (from e) (to e)) (to e) (from e)) listed m) i)); [| apply G; now left].
  clear I. induction listed as [| t l IH]; intros m [I | I]; simpl; [destruct I | exact I | |].
  - apply IH. destruct I as [-> | I]; [right | now left]. destruct Q as [[<- <-] | [<- <-]].
    + apply add_partner_keeps. now apply add_partner_adds.
    + now apply add_partner_adds.
  - apply IH. right. now apply add_partner_keeps, add_partner_keeps.
Qed.
End Partners.

(* ---- the sites that may be narrowed ---- *)

Section Still.
Variables (D E : Z) (l : list site) (edges : list edge) (B B' : sites) (still : list Z).
Variable accepted : check D E l edges = true.
Variable described : describes l B.
Variable narrower : refined (length l) B' B.
Variable stays : forall k i, named l k i -> In i still -> refines (B k) (B' k).
Variable bs : list box.
Variable scale : scaled_sites D E l = Some bs.

Notation N := (length l).
Notation some := (movable still bs).
Notation moves := (index box_name some).

Lemma point_found i b : find_box bs i = Some b -> is_point b = true ->
  xlo (B (position bs i)) = xhi (B (position bs i)) /\ ylo (B (position bs i)) = yhi (B (position bs i)).
Proof.
  intros F Pt. destruct (found_box D E l edges B accepted described bs scale i b F) as ((X0 & X1 & Y0 & Y1) & _).
  pose proof (positive_unit D E l edges accepted) as U. unfold is_point in Pt. rewrite andb_true_iff, !Z.eqb_eq in Pt.
  destruct Pt as [Px Py]. rewrite <- Px in X1. rewrite <- Py in Y1.
  split; apply (Rmult_eq_reg_r (unit D E)); lra.
Qed.

Lemma others_stay k i : named l k i -> is_in moves i = false -> B' k = B k.
Proof.
  intros A H. destruct (named_box D E l edges B accepted described bs scale k i A) as (b & T & F & M & <-).
  pose proof (named_below _ _ _ A) as K. destruct (is_point b) eqn:Pt.
  { destruct (point_found i b F Pt) as [X Y]. apply point_same; [exact X | exact Y | now apply narrower]. }
  destruct (Map.find i (index (fun i => i) still)) as [j |] eqn:Q.
  { apply index_in in Q. destruct Q as [I Q]. subst j. apply rect_same; [now apply narrower | now apply (stays _ i)]. }
  exfalso. assert (I : In b some).
  { apply in_kept; [exact (nth_error_In _ _ T) |]. now rewrite Pt, M, Q. }
  apply (is_in_index box_name) in I. rewrite M in I. congruence.
Qed.

(* When no site may be narrowed, no rectangle changes. *)
Lemma all_stay k : (k < N)%nat -> some = [] -> B' k = B k.
Proof.
  intros K H. destruct (nth_error l k) as [s |] eqn:S; [| now apply nth_error_None in S; lia].
  apply (others_stay k (name s)); [now exists s |]. now rewrite H.
Qed.

Definition changing (k : nat) : Prop := exists i, named l k i /\ is_in moves i = true.

Lemma unchanging k i : named l k i -> is_in moves i = false -> ~ changing k.
Proof. intros [s [S M]] F [j [[t [T M']] G]]. congruence. Qed.

Lemma same_others k : (k < N)%nat -> ~ changing k -> B' k = B k.
Proof.
  intros K Not. destruct (nth_error l k) as [s |] eqn:S; [| now apply nth_error_None in S; lia].
  assert (A : named l k (name s)) by now exists s. apply (others_stay k (name s) A).
  destruct (is_in moves (name s)) eqn:Q; [| reflexivity]. destruct Not. now exists (name s).
Qed.

Variable listed : list edge.
Variable all : lists_all l B listed.
Notation near := (movable_partners moves listed).

Lemma partner_listed a i k n : named l a i -> ~ changing a -> named l k n -> is_in moves n = true -> possible N B a k ->
  In n (partners near i).
Proof.
  intros A Ca K M P. assert (Dif : a <> k) by (intros ->; apply Ca; now exists n).
  destruct (all a k i n A K Dif P) as (e & I & Q). exact (partners_found moves listed e i n I M Q).
Qed.

Lemma only_point i k : named l k i -> is_point_of (index box_name bs) i = true -> exists p, forall z, inside z (B k) -> z = p.
Proof.
  intros A H. unfold is_point_of in H. destruct (Map.find i (index box_name bs)) as [b |] eqn:Q; [| discriminate].
  apply (sought_box D E l edges accepted bs scale) in Q. destruct (point_found i b Q H) as [X Y].
  destruct (named_box D E l edges B accepted described bs scale k i A) as (_ & _ & _ & _ & <-).
  exists (xlo (B (position bs i)), ylo (B (position bs i))). intros [u v] [Zx Zy]. simpl in *. f_equal; lra.
Qed.

Theorem open_pair_stays e a b : stays_open (index box_name bs) moves near e = true -> named l a (from e) -> named l b (to e) ->
  (possible N B a b -> possible N B' a b) /\ (legal N B' a b -> legal N B a b).
Proof.
  intros H A G. pose proof (named_below _ _ _ A) as Ka. pose proof (named_below _ _ _ G) as Kb.
  unfold stays_open in H. cbv zeta in H. rewrite !andb_true_iff, !negb_true_iff in H. destruct H as [[Ma Mb] H].
  pose proof (unchanging a _ A Ma) as Ca. pose proof (unchanging b _ G Mb) as Cb.
  assert (Both : forall k, (k < N)%nat -> changing k -> possible N B a k -> ~ possible N B b k).
  { intros k K [n [Nk M]] P Q. pose proof (partner_listed a _ k n A Ca Nk M P) as I.
    pose proof (partner_listed b _ k n G Cb Nk M Q) as J.
    destruct (partners near (from e)) as [| x r]; [destruct I |]. rewrite andb_true_iff, forallb_forall in H.
    destruct H as [_ H]. specialize (H n I). rewrite negb_true_iff in H.
    assert (X : existsb (Z.eqb n) (partners near (to e)) = true) by (apply existsb_exists; exists n; split; [exact J | apply Z.eqb_refl]).
    congruence. }
  split.
  - intros P. apply NNPP. intros Not.
    destruct (possible_ends N B B' changing narrower same_others a b Ka Kb Ca Cb P Not) as (_ & k & K & Ck & _ & Pa & Pb & _).
    exact (Both k K Ck Pa Pb).
  - intros L. assert (Cases : (partners near (from e) = [] /\ partners near (to e) = []) \/
      (is_point_of (index box_name bs) (from e) = true /\ is_point_of (index box_name bs) (to e) = true)).
    { destruct (partners near (from e)), (partners near (to e)); [now left | | |]; right; rewrite !andb_true_iff in H; tauto. }
    destruct Cases as [[Na Nb] | [Pa Pb]].
    + apply NNPP. intros Not. destruct L as [c W].
      destruct (witness_begins N B B' changing narrower same_others a b c Ka Kb Ca Cb Not W) as (k & K & [n [Nk M]] & [P | P]);
        apply possible_sym in P.
      * pose proof (partner_listed a _ k n A Ca Nk M P) as I. now rewrite Na in I.
      * pose proof (partner_listed b _ k n G Cb Nk M P) as I. now rewrite Nb in I.
    + destruct (only_point _ _ A Pa) as [p Hp]. destruct (only_point _ _ G Pb) as [q Hq].
      exact (points_were_legal N B B' changing narrower same_others a b p q Ka Kb Ca Cb Hp Hq Both L).
Qed.
End Still.

(* For whatever goal: nothing can be narrowed, so that no bound changes either. *)
Theorem everybody_stays D E l edges B B' still : check D E l edges = true -> describes l B ->
  (forall bs, scaled_sites D E l = Some bs -> movable still bs = []) -> refined (length l) B' B ->
  (forall k i, named l k i -> In i still -> refines (B k) (B' k)) -> forall k, (k < length l)%nat -> B' k = B k.
Proof.
  intros C F H Q S k K. destruct (accepted_parts D E l edges C) as (bs & Sc & _).
  exact (all_stay D E l edges B B' still C F Q S bs Sc k K (H bs Sc)).
Qed.

Lemma same_pairs N B B' a b : (a < N)%nat -> (b < N)%nat -> (forall k, (k < N)%nat -> B' k = B k) ->
  (possible N B a b -> possible N B' a b) /\ (legal N B' a b -> legal N B a b).
Proof.
  intros Ka Kb Same. split.
  - apply possible_monotone; try assumption. intros k K z. now rewrite (Same k K).
  - intros [c W]. exists c. apply (witness_monotone N B B'); try assumption. intros k K z. now rewrite (Same k K).
Qed.

(* `opened`: the pairs that are not known to be legal; those of them that are not `loose` are ties, as CheckerTiesSound.v,
   CheckerTiedSound.v shows them. *)
Theorem outcome_fixpoint D E l edges opened loose B B' still complete a b i j :
  check D E l edges = true -> describes l B -> (complete = true -> lists_all l B (rev_append opened edges)) ->
  is_fixpoint D E l still complete edges opened loose = true -> refined (length l) B' B ->
  (forall k n, named l k n -> In n still -> refines (B k) (B' k)) ->
  (forall e k m, In e opened -> ~ In e loose -> named l k (from e) -> named l m (to e) ->
    possible (length l) B' k m /\ ~ legal (length l) B' k m) ->
  named l a i -> named l b j -> a <> b ->
  (possible (length l) B' a b <-> possible (length l) B a b) /\ (legal (length l) B' a b <-> legal (length l) B a b).
Proof.
  intros C F All H Q S Tied A G M. pose proof (named_below _ _ _ A) as Ka. pose proof (named_below _ _ _ G) as Kb.
  assert (Down : possible (length l) B' a b -> possible (length l) B a b) by now apply possible_monotone.
  assert (Up : legal (length l) B a b -> legal (length l) B' a b).
  { intros [c W]. exists c. now apply (witness_monotone _ B' B). }
  cut ((possible (length l) B a b -> possible (length l) B' a b) /\ (legal (length l) B' a b -> legal (length l) B a b)); [tauto |].
  destruct (accepted_parts D E l edges C) as (bs & Sc & _). unfold is_fixpoint in H. rewrite Sc in H.
  destruct (movable still bs) as [| x r] eqn:Mv.
  { apply same_pairs; [exact Ka | exact Kb |]. intros k K. exact (all_stay D E l edges B B' still C F Q S bs Sc k K Mv). }
  rewrite <- Mv in H. clear x r Mv. cbv zeta in H. rewrite andb_true_iff, forallb_forall in H. destruct H as [Cp H].
  specialize (All Cp).
  assert (Cases : possible (length l) B a b -> legal (length l) B a b \/
    ((possible (length l) B a b -> possible (length l) B' a b) /\ (legal (length l) B' a b -> legal (length l) B a b))).
  { intros P. destruct (All a b i j A G M P) as (e & I & N). rewrite rev_append_rev in I. apply in_app_iff in I.
    destruct I as [I | I].
    2:{ left. apply (listed_legal D E l edges B e a b C F I). destruct N as [[<- <-] | [<- <-]]; tauto. }
    apply in_rev in I. right. destruct (classic (In e loose)) as [L | L].
    - specialize (H e L). destruct N as [[<- <-] | [<- <-]].
      + exact (open_pair_stays D E l edges B B' still C F Q S bs Sc _ All e a b H A G).
      + destruct (open_pair_stays D E l edges B B' still C F Q S bs Sc _ All e b a H G A) as [X Y].
        split; [intros Z; now apply possible_sym, X, possible_sym | intros Z; now apply legal_sym, Y, legal_sym].
    - destruct N as [[<- <-] | [<- <-]].
      + destruct (Tied e a b I L A G) as [X Y]. split; [now intros | now intros Z].
      + destruct (Tied e b a I L G A) as [X Y]. split; [intros _; now apply possible_sym | intros Z; destruct Y; now apply legal_sym]. }
  split.
  - intros P. destruct (Cases P) as [L | [X _]]; [apply legal_possible; auto | now apply X].
  - intros L. destruct (Cases (Down (legal_possible _ _ _ _ Ka Kb L))) as [L' | [_ Y]]; [exact L' | now apply Y].
Qed.

(* Of points there is nothing narrower; of ties of points nothing changes. *)
Theorem fixpoint_of_ties D E l edges opened B B' still complete hint a b i j :
  check D E l edges = true -> describes l B -> (complete = true -> lists_all l B (rev_append opened edges)) ->
  is_fixpoint D E l still complete edges opened (loose_ties D E l hint opened) = true -> refined (length l) B' B ->
  (forall k n, named l k n -> In n still -> refines (B k) (B' k)) -> named l a i -> named l b j -> a <> b ->
  (possible (length l) B' a b <-> possible (length l) B a b) /\ (legal (length l) B' a b <-> legal (length l) B a b).
Proof.
  intros C F All H Q S. apply (outcome_fixpoint D E l edges opened (loose_ties D E l hint opened) B B' still complete); try assumption.
  intros e k m I L X Y. exact (tie_stays D E l edges B B' hint opened e k m C F I L X Y Q).
Qed.
